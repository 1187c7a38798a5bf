#!/bin/sh
# koksma-cells, and the parts of koksma-eval, as their users meet them.
. "${top_srcdir:=.}/tests/cli_rows.sh"

head="# koksma: integrand=ball dim=2 r=0.4
# n${tab}k${tab}cells${tab}K${tab}K_lower${tab}K_upper${tab}touched${tab}V${tab}M"

# ---- Counting ------------------------------------------------------------------

t ball 0 "$head
64${tab}8${tab}64${tab}28${tab}28${tab}28${tab}0${tab}0.4375${tab}28
1024${tab}32${tab}1024${tab}100${tab}100${tab}100${tab}0${tab}0.09765625${tab}100" "" \
    'koksma-cells ball -n 2^6,2^10 | cut -f 1-9'
t facts 0 "2${tab}2${tab}2${tab}1${tab}1.4142135623730951${tab}1.2${tab}2" "" \
    'koksma-cells mixture -a .4 -n 2^8 -q 2>/dev/null | cut -f 10-14,17,19'
t aligned 0 "1000${tab}31${tab}961${tab}31${tab}60" \
    "koksma-cells: N = 1000: the discontinuity is aligned with the grid: it meets 31 cells, and only touches the faces of 60 more" \
    'koksma-cells f2 -n 1000 -q | cut -f 1-4,7'
t on-the-faces 0 "0${tab}16
9${tab}0" \
    "koksma-cells: N = 64: the discontinuity is aligned with the grid: it meets 0 cells, and only touches the faces of 16 more" \
    'koksma-cells box -a .5 -n 64,81 -q | cut -f 4,7'
t large 0 "1048576${tab}1099511627776${tab}1258291" "" \
    'koksma-cells halfspace -a .3 -n 2^40 -q | cut -f 2-4'
t ranges 0 "16 64 256 1000" "" \
    'echo $(koksma-cells ball -n 2^4:2^8,1000 -q | cut -f 1 | grep -v -e 32 -e 128)'
t most 0 "4294967295" "" \
    'koksma-cells sum -n 18446744073709551615 -q | cut -f 2'
t elementary 0 "720${tab}16x9x5" "" \
    'koksma-cells ball -d 3 -n 2^10 --elementary -q | cut -f 3,23'
t own-bases 0 "27x25" "" 'koksma-cells ball -n 700 --bases 3,5 -q | cut -f 23'
t fractal 0 "1.3652${tab}line" "" \
    'koksma-cells fractal2 -n 5^8 --ratio 5 -q 2>/dev/null | awk "{ printf \"%.4f\t%s\n\", \$20, \$22 }"'
has what-was-done 0 'N = 1024: 4.* boxes' 'koksma-cells ball -v'
t deadline 3 "nan" "koksma-cells: stopped before all cells were counted" \
    'koksma-cells ball -n 2^60 -t .2 -q >o; s=$?; cut -f 4 o
     awk "{ exit !(\$5 > 0 && \$5 < \$6) }" o && exit $s'
t interrupt 3 "nan" "koksma-cells: stopped before all cells were counted" \
    '{ koksma-cells ball -n 2^60 -q -t 60 >o & p=$!; ./caught $p; kill -INT $p; wait $p; s=$?
       cut -f 4 o; exit $s; }'

# ---- Lines ---------------------------------------------------------------------

t lines 0 "2${tab}1${tab}1" "" \
    'koksma-cells f2 -m lines -q | awk "{ print \$10 \"\t\" \$17 \"\t\" \$20 }"'
has scene 0 '^1024	' 'koksma-cells sphere --bounces 2 --lines 50'
t axes 0 "# koksma: integrand=f2 dim=2 a=0
# axis${tab}area
1${tab}1
2${tab}1" "" 'koksma-cells f2 --axes | cut -f 1,2'
has lines-deadline 3 'stopped after [0-9]* lines' \
    'koksma-cells ball --lines 1e9 -m lines -t .1'
has lines-done 0 'lines of each kind' 'koksma-cells sum -m lines --lines 9 -v'

# ---- Points --------------------------------------------------------------------

t samples 0 "4${tab}4${tab}2${tab}0" \
    "koksma-cells: from samples alone: whatever is smaller than some cells is not seen, and a steep slope counts as a jump" \
    'printf ".1 .1 0\n.9 .1 1\n.1 .9 0\n.9 .9 1\n" | koksma-cells -m samples -q |
     awk "{ print \$3 \"\t\" \$5 \"\t\" \$6 \"\t\" \$4 }"'
t samples-of-many 1 "" \
    "koksma-cells: set 1 has more than two values; --jump says which differences are jumps" \
    'printf ".1 .1 0\n.9 .1 1\n.1 .9 2\n.9 .9 1\n" | koksma-cells -m samples -q'
has samples-told 0 '^4	' 'printf ".1 .1 0\n.9 .1 1\n.1 .9 2\n.9 .9 1\n" |
     koksma-cells -m samples --jump .5'
t occupancy 0 "# n${tab}k${tab}cells${tab}least${tab}most${tab}empty${tab}empty_share
1024${tab}32${tab}1024${tab}0${tab}2${tab}210${tab}0.205078125" "" \
    'koksma-points halton -n 1024 | koksma-cells --occupancy'
t occupancy-digits 0 "5184${tab}72${tab}5184${tab}1${tab}1${tab}0${tab}0" "" \
    'koksma-cells --occupancy --family halton --elementary -n 5184 -q'
t occupancy-doubles 0 "5184${tab}72${tab}5184${tab}0${tab}2${tab}80" "" \
    'koksma-points halton -n 5184 | koksma-cells --occupancy --elementary -q | cut -f 1-6'
t occupancy-sets 0 "1${tab}1${tab}1
2${tab}2${tab}2" "" \
    'printf ".5\n\n.5\n.1\n" | koksma-cells --occupancy -q | cut -f 1,2,4'
t occupancy-first 0 "2${tab}1" "" \
    'printf ".1\n.9\n.95\n" | koksma-cells --occupancy -n 2 -q | cut -f 1,5'

# ---- What cannot be ------------------------------------------------------------

usage() { has "$1" 2 "$2" "$3"; }
usage nothing 'name one integrand' 'koksma-cells'
usage unknown 'no integrand is called' 'koksma-cells nonesuch'
usage method '^koksma-cells: -m takes auto' 'koksma-cells ball -m guess'
usage no-oracle 'see -m lines' 'koksma-cells sphere -m exact'
usage zero '^koksma-cells: -n takes' 'koksma-cells ball -n 0'
usage falls 'numbers that rise' 'koksma-cells ball -n 4,2'
usage parameter 'ball has r from' 'koksma-cells ball -a 3'
usage bases-count '3 bases for 2' 'koksma-cells ball --bases 2,3,5'
usage bases-common 'common factor' 'koksma-cells ball --bases 2,4'
usage many-dims 'at most 15' 'koksma-cells ball -d 16 --elementary'
usage family '^koksma-cells: --family takes halton' \
    'koksma-cells --occupancy --family sobol'
usage start '^koksma-cells: --start is for --occupancy' 'koksma-cells ball --start 3'
usage dim-of-points '-d is not for points, which say the dimension' \
    'koksma-cells --occupancy -d 2'
usage start-of-points 'goes with --family' 'koksma-cells --occupancy --start 3'
usage parameter-of-samples '^koksma-cells: -a is for an integrand, which is not looked at' \
    'koksma-cells -m samples -a 3'
usage lines-of-points '--lines is for an integrand' 'koksma-cells --occupancy --lines 5'
usage method-of-points '-m is not for --occupancy' 'koksma-cells --occupancy -m lines'
usage jump-of-ball '--jump is for -m samples' 'koksma-cells ball --jump 3'
usage bounces-differ '--bounces 1 of sphere is dimension 2, and -d says 6' \
    'koksma-cells sphere -d 6 --bounces 1'
t bounces-agree 0 "1024" "" \
    'koksma-cells sphere -d 4 --bounces 2 --lines 50 -q | cut -f 1'
usage part '^koksma-eval: --piece takes smooth or jump' 'koksma-eval f2 --piece x'
t more-than-there-are 1 "" "koksma-cells: set 1 has 1 point, and -n asks for 9" \
    'echo .5 | koksma-cells --occupancy -n 9 -q'
t outside 1 "" \
    "koksma-cells: line 1: coordinate 1 is 1.5, not in [0,1]" \
    'echo 1.5 | koksma-cells --occupancy -q'
[ -w /dev/full ] && t full-disk 1 "" \
    "koksma-cells: standard output: cannot write: No space left on device" \
    'koksma-cells ball >/dev/full'
t head 0 "16" "" 'koksma-cells ball -n 2^4:2^12 -q | head -n 1 | cut -f 1'

# ---- Parts ---------------------------------------------------------------------

t smooth 0 "# koksma: integrand=f2 dim=2 piece=smooth a=0.25 exact=0.25 variance=0.010416666666666666
# x1${tab}x2${tab}f2
0.5${tab}0.75${tab}0.3125" "" 'echo .5 .75 | koksma-eval f2 -a .25 --piece smooth'
t jump 0 "0.5${tab}0.75${tab}0.5" "" \
    'echo .5 .75 | koksma-eval f2 -a .25 --piece jump -q'
t add-up 0 "0" "" \
    'koksma-points halton -n 999 >p
     for part in smooth jump; do koksma-eval mixture -a .3 -q --piece $part p >$part; done
     koksma-eval mixture -a .3 -q p | paste - smooth jump |
     awk "{ d = \$3 - \$6 - \$9; if (d < 0) d = -d; n += d > 1e-15 } END { print n }"'
t parts-of-all 0 "0 0" "" \
    'koksma-eval --list --piece smooth -q >s; koksma-eval --list --piece jump -q >j
     koksma-eval --list -q | paste - s j | awk -F "\t" "
     { d = \$4 - \$19 - \$34; if (d < 0) d = -d; n += d > 1e-13 * (\$4 < 0 ? -\$4 : \$4)
       m += \$22 != 0 } END { print n, m }"'

rows_end
