#!/bin/sh
# trade_plot.sh TABLES FOLDER [KNOB]...: a figure a knob, or those named,
# FOLDER/KNOB.png and .svg, by gnuplot (or what GNUPLOT names) from the tables of
# trade.sh and bench_radical in TABLES.
# shellcheck disable=SC2016 # what is in single quotes is for awk and gnuplot
set -eu
tables=$(cd "$1" && pwd)
mkdir -p "$2"
figures=$(cd "$2" && pwd)
shift 2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# curves TABLE KEY PROGRAM: the rows of TABLE.tsv in a file a curve, which is named by
# the awk expression KEY; PROGRAM may change the fields or drop the row before.
curves() {
    rm -rf curves
    mkdir curves
    awk -F '\t' -v OFS='\t' "/^#/ { next } { $3; print >(\"curves/\" $2) }" \
        "$tables/$1.tsv"
}

# each PATTERN STYLE: elements of a plot, one a curve, each in its colour.
each() {
    colour=0 IFS=''
    for curve in curves/$1; do
        colour=$((colour + 1))
        printf "'%s' %s lc %d title '%s', " "$curve" "$2" "$colour" "${curve#curves/}"
    done
}

# labels PATTERN USING: a small label beside each point.
labels() {
    IFS=''
    for curve in curves/$1; do
        printf "'%s' using %s with labels font ',8' tc rgb '#555555' offset 0.4,0.6 left notitle, " \
            "$curve" "$2"
    done
}

# figure KNOB WIDTH: the script on standard input, in both forms.
figure() {
    cat >script
    for form in png svg; do
        {
            echo "scale = '$form' eq 'svg' ? 1 : 1.5"
            if [ $form = svg ]; then
                echo "set terminal svg size $2,560 font 'sans,13' background rgb 'white'"
            else
                echo "if (strstrt(GPVAL_TERMINALS, 'pngcairo')) {"
                echo "set terminal pngcairo size 1.5*$2,840 fontscale 1.5 font 'sans,9'"
                echo "} else { set terminal png size 1.5*$2,840 }"
            fi
            cat <<'STYLE'
set datafile separator tab
set linetype 1 lc rgb '#0072b2' lw 1.5 pt 7 ps 0.6
set linetype 2 lc rgb '#d55e00' lw 1.5 pt 5 ps 0.6
set linetype 3 lc rgb '#009e73' lw 1.5 pt 9 ps 0.7
set linetype 4 lc rgb '#cc79a7' lw 1.5 pt 13 ps 0.7
set linetype 5 lc rgb '#e69f00' lw 1.5 pt 11 ps 0.7
set linetype 6 lc rgb '#56b4e9' lw 1.5 pt 4 ps 0.6
set grid lt 1 lw 0.7 lc rgb '#dddddd'
set tics nomirror
set format '%g'
STYLE
            echo "set output '$figures/$1.$form'"
            sed 's/, $//' script # the last element has no comma behind it
        } | "${GNUPLOT:-gnuplot}"
    done
    echo "$figures/$1.png and .svg"
}

log_axes='set logscale xy; set format xy "10^{%T}"'
seconds='set xlabel "CPU seconds of one thread"'
# Widths of finished answers are one or two units in the last place: the lowest tic.
least=0.005
width="set ylabel 'width of the interval, as a share of its lower end'
    set ytics add ('exact' $least)"

star() { # KNOB TITLE LETTER
    curves "trade_$1" '$1' "\$6 = \$6 < $least ? $least : \$6"
    figure "$1" 900 <<END
$log_axes; $seconds; $width
set title 'koksma-star $3: $2'
set yrange [$least / 1.3:]
set key bottom left
plot $(each '*' 'using 3:6 with linespoints') $(labels '*' "3:6:(strcol(2))")
END
}

star_search() {
    awk -F '\t' '/^#/ { next } $5 > best[$1] { best[$1] = $5 }
        END { for (set in best) print set "\t" best[set] }' \
        "$tables/trade_star_search.tsv" >best
    curves trade_star_search '$1' '
        if (!read) {
            while ((getline line <"best") > 0) { split(line, b, "\t"); best[b[1]] = b[2] }
            read = 1
        }
        $5 /= best[$1]
        if ($2 > 1 && $2 != seed) print "" >("curves/" $1)
        seed = $2'
    figure star_search 900 <<END
set logscale x; $seconds
set title 'koksma-star -m search: the lower bound as time goes on, five seeds each'
set ylabel 'lower bound found, as a share of the best of all'
set yrange [:1.01]
set key bottom right
plot $(each '*' 'using 3:5 with steps')
END
}

l2_method() {
    curves trade_l2_method '$1 ", dim " $2' '$7 = $7 < 1e-17 ? 1e-17 : $7'
    figure l2_method 1200 <<END
set multiplot layout 1,2 title 'koksma-l2 -m: all pairs, or divide and conquer'
$log_axes
set xlabel 'n, points'
set key top left
set ylabel 'CPU seconds of one thread'
plot $(each 'divide*' 'using 3:4 with linespoints dt 1') $(each 'pairs*' 'using 3:4 with linespoints dt 2')
set ylabel 'width of the interval, as a share of its lower end'
plot $(each 'divide*' 'using 3:7 with linespoints dt 1') $(each 'pairs*' 'using 3:7 with linespoints dt 2')
END
}

cells_lines() {
    curves trade_cells_lines '$1 ", dim " $2' "
        if (\$1 == \"exact\") { # a level a dimension, so that labels stand apart
            \$11 = $least * 1.25^(3 - \$2)
            \$3 = \"N = 2^{\" log(\$4) / log(2) \"}\"
        }"
    figure cells_lines 900 <<END
$log_axes; $seconds; $width
set title "koksma-cells ball: the cells that it meets, by as many lines an axis,\n or exactly, of as many cells"
set yrange [$least / 1.6:]
plot $(each 'lines*' 'using 5:11 with linespoints') $(each 'exact*' 'using 5:11 with points') \
    $(labels '*' "5:11:(strcol(3))")
END
}

variation_cells() {
    curves trade_variation_cells '($1 == "grid" ? "dim " $2 : "random, dim " $2)' \
        '$13 = ($3 + 1)^$2'
    figure variation_cells 1200 <<END
set multiplot layout 1,2 title "koksma-variation gaussian: grids, and random cells"
$log_axes
set xlabel 'nodes of the grid'
set ylabel 'share of the variation that the grid lacks'
plot $(each 'dim*' 'using 13:10 with linespoints')
$seconds
set format '%g'
set ylabel 'width of the interval for V_k, as a share of its lower end'
plot $(each 'random*' 'using 5:11 with linespoints') \
    $(labels 'random*' '5:11:(sprintf("2^{%d} samples", log($4) / log(2)))')
END
}

fit_replicates() {
    curves trade_fit_replicates '"seeds 1 to 5"' '$8 = $1 * (0.85 + 0.05 * $2)'
    figure fit_replicates 1200 <<END
set multiplot layout 1,2 title "koksma-fit of f2, N to 2^{14}: what replicates buy"
set logscale x 2
set xlabel 'replicates'
set ylabel 'exponent, and its interval at 95 %'
set xrange [3:350]
plot $(each '*' 'using 8:4:5:6 with yerrorbars pt 7 ps 0.5') \
    -0.75 lw 2 dt 2 lc rgb '#888888' title 'theory'
set logscale xy
set ylabel 'width of the interval'
plot $(each '*' 'using 8:7 with points pt 7') \
    0.5 / sqrt(x) lw 2 dt 2 lc rgb '#888888' title 'like R^{-1/2}'
END
}

radical() {
    curves radical '$1' 1
    figure radical 1200 <<END
set multiplot layout 1,2 title 'Radical inverses of 2^{20} indices from 2^{32} on'
set logscale x; set xrange [1.7:700]; set xtics (2, 3, 10, 29, 541)
set xlabel 'base'
set logscale y; set yrange [2:1000]
set ylabel 'CPU nanoseconds a point'
plot $(each '[!d]*' 'using 2:5 with linespoints') \
    'curves/digits' using 2:5 with linespoints lc 5 title 'digits'
unset logscale y; set yrange [-0.2:6]
set ylabel 'largest error, in units in the last place'
plot $(each '[!d]*' 'using 2:6 with linespoints')
END
}

text_npy() {
    curves trade_text_npy '$1' '$8 = 1e9 * $3 / $2; $9 = 1e9 * $4 / $2'
    figure text_npy 1200 <<END
set multiplot layout 1,2 title 'Random points in the plane as text, --hex or --npy'
set logscale xy; set format x '10^{%T}'
set xlabel 'n, points'
set ylabel 'CPU nanoseconds a point'
set yrange [10:10000]
set title 'made and written by koksma-points'
plot $(each '*' 'using 2:8 with linespoints')
set title 'read by koksma-error'
plot $(each '*' 'using 2:9 with linespoints')
END
}

star_tolerance() { star star_tolerance 'what is asked, by the points, and what it costs' -e; }

star_time() { star star_time 'seconds asked by the clock, by the points, and what they buy' -t; }

[ $# -gt 0 ] || set -- star_tolerance star_time star_search l2_method cells_lines \
    variation_cells fit_replicates radical text_npy
for knob; do
    "$knob"
done
