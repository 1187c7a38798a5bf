#!/bin/sh
# Points and the domain of discontinuity: the paper's figure 2.  72 = 2^3 3^2 Halton
# points, one in each of the 8 by 9 cells, beside as many random ones; shaded are the
# cells that the line x+y = 1 passes through, which alone make the error of f2, a = 0.
. "$(dirname "$0")/common.sh"

koksma-points halton -n 72 >halton
koksma-points random -n 72 >random

# With 72 in place of 1 the cells are 9 wide and 8 high, and corners are whole numbers.
# A cell is on the line when its upper right corner is above and its lower left below.
awk 'BEGIN { for (i = 0; i < 8; i++) for (j = 0; j < 9; j++)
    if (9 * i + 8 * j < 72 && 9 * (i + 1) + 8 * (j + 1) > 72) print i / 8, j / 9 }' >cells

# How many cells stay empty, and how many points the fullest has.  The index of a cell
# is read off doubles here: 1e-9 makes up for coordinates just below j/9.
count() {
    awk '!/^#/ { n[int(8 * $1 + 1e-9), int(9 * $2 + 1e-9)]++ }
    END { for (c in n) { full++; if (n[c] > most) most = n[c] }
        printf "%d cells empty, most in a cell: %d", 72 - full, most }' "$1"
}

for form in svg png; do
    case $form in
    svg) terminal="'svg' size 1000,560 font 'sans,14' background rgb 'white'" ;;
    png) terminal="(strstrt(GPVAL_TERMINALS, 'pngcairo') ? 'pngcairo' : 'png') size 1500,840 fontscale 1.5" ;;
    esac
    gnuplot -d >"$figures/figure2.$form" <<END
set terminal $terminal
set multiplot layout 1,2 title "72 points and the $(wc -l <cells | tr -d ' ') of 72 cells that x+y = 1 passes through"
unset key
set size square
set xrange [0:1]; set yrange [0:1]
set xtics ('0' 0, '1' 1, '' 1./8, '' 2./8, '' 3./8, '' 4./8, '' 5./8, '' 6./8, '' 7./8)
set ytics ('0' 0, '1' 1, '' 1./9, '' 2./9, '' 3./9, '' 4./9, '' 5./9, '' 6./9, '' 7./9, '' 8./9)
set xlabel 'x' offset 0,0.5; set ylabel 'y' offset 1,0
set grid front lt 1 lw 0.5 lc rgb '#aaaaaa'
do for [name in 'halton random'] {
    set title (name eq 'halton' ? "Halton: $(count halton)" : "random: $(count random)")
    plot 'cells' using 1:2:1:(\$1+1./8):2:(\$2+1./9) with boxxyerror fs solid noborder lc rgb '#f6dcb5', \
        1-x with lines lw 2 lc rgb '#d55e00', name with points pt 7 ps 0.7 lc rgb '#0072b2'
}
END
done
echo "$figures/figure2.svg and .png"
