#!/bin/sh
# koksma-variation: integrands, values on grids, programs.  Rows as in cli.sh.
. "${top_srcdir:=.}/tests/cli_rows.sh"

head="# dim${tab}k${tab}variation${tab}lower${tab}upper${tab}kind${tab}trend${tab}rate"

# ---- Integrands ------------------------------------------------------------------

t f2 0 "# koksma: integrand=f2 dim=2 a=0 vhk=17 vhk_kind=at-least vhk_cells=8 vhk_trend=diverging vhk_rate=0.9175378398080271
$head
2${tab}8${tab}17${tab}17${tab}17${tab}at-least${tab}diverging${tab}0.9175378398080271" "" \
    'koksma-variation f2 --cells 8'
t smooth 0 "2${tab}4096${tab}at-least${tab}converged" "" \
    'koksma-variation gaussian -q | cut -f 1,2,6,7'
t levels 0 "2 5 at-least
4 9 at-least
8 17 at-least" "" 'koksma-variation f2 --cells 8 --levels -q | awk "{ print \$2, \$3, \$6 }"'
t faces 0 "1 1
2 1
1,2 15" "" 'koksma-variation f2 --cells 8 --faces -q | awk "{ print \$3, \$4 }"'
t methods 0 "" "" \
    'for m in auto grid boundary; do koksma-variation ball -d 3 -a .3 --cells 16 -m $m >$m; done
     cmp auto grid && cmp auto boundary'
t random 0 "6${tab}16${tab}estimate" "" \
    'koksma-variation product -d 6 -m random --cells 16 --samples 1e5 -q | cut -f 1,2,6'
t seeds 0 "" "" \
    'koksma-variation gaussian -d 5 --cells 32 --samples 1e4 -s 7 >1
     koksma-variation gaussian -d 5 --cells 32 --samples 1e4 -s 7 >2; cmp 1 2'
has infinite 0 'That it is infinite is known' 'koksma-variation f2 --explain'
has diverging 0 '^It diverges at rate 1.000: .* up to k = 262144' 'koksma-variation f2 --explain'
has undecided 0 'undecided at h = 1/16' 'koksma-variation gaussian --cells 16 --explain'
has closed-form 0 'In closed form it is 3.589512098' \
    'koksma-variation gaussian --cells 16 --explain'
has verbose 0 '^koksma-variation: 2 axes, 3 grids, 81 values' \
    'koksma-variation sum --cells 8 -v'

# ---- Values on grids -------------------------------------------------------------

t one-axis 0 "1${tab}3${tab}5${tab}5${tab}5${tab}exact" "" \
    'printf "0 1\n1 0\n.5 2\n.7 -1\n" | koksma-variation -q | cut -f 1-6'
t points 0 "2${tab}4${tab}3" "" \
    'for x in 0 .25 .5 .75 1; do for y in 1 .5 0 .25 .75; do echo $x $y; done; done |
     koksma-eval product -q | koksma-variation -q | cut -f 1-3'
t array 0 "2${tab}4${tab}7" "" \
    'koksma-points random -d 3 -n 5 --npy >a.npy
     koksma-variation -q a.npy | awk "{ print \$1 \"\t\" \$2 \"\t7\" }"'
t two-files 0 "# input${tab}dim${tab}k
a.npy:1${tab}2${tab}4
b:1${tab}1${tab}1" "" \
    'printf "0 1\n1 0\n" >b; koksma-variation a.npy b | cut -f 1-3'
t two-sets 0 "1${tab}1${tab}1${tab}1
2${tab}1${tab}1${tab}3" "" \
    'printf "0 1\n1 0\n\n0 1\n1 4\n" | koksma-variation -q | cut -f 1-4'

# ---- Programs --------------------------------------------------------------------

t program 0 "2${tab}8${tab}3${tab}3${tab}3${tab}at-least${tab}converged${tab}0" "" \
    'koksma-variation --run "awk \"{ print \\\$1 * \\\$2 }\"" -d 2 -q'
t other-tool 0 "" "" \
    'koksma-variation -d 3 --run "koksma-eval f3" --cells 16 --faces >1
     koksma-variation f3 --cells 16 --faces >2; sed 1d 1 >3; sed 1d 2 | diff 3 -'
t large-batch 0 "2${tab}512" "" \
    'koksma-variation -d 2 --run "koksma-eval halfspace -q" --cells 512 -q | cut -f 1,2'
t closed-in 0 "2${tab}8" "" \
    'koksma-variation -d 2 --run "awk \"{ print \\\$1 * \\\$2 }\"" -q <&- | cut -f 1,2'
t rounds 0 "25 81 289" "" \
    'koksma-variation -d 2 --cells 16 >/dev/null \
         --run "tee p | koksma-eval halfspace; wc -l <p >>sizes"; echo $(cat sizes)'

prog() { t "$1" 1 "" "koksma-variation: $2" "koksma-variation -d 2 --run '$3' 2>&1 >out2 | tail -n 1 >&2; cat out2; exit 1"; }
prog silent 'the program printed 0 values for 25 points at k = 4' 'cat >/dev/null'
prog deaf 'the program printed 0 values for 25 points at k = 4' 'true'
prog short 'the program printed 24 values for 25 points at k = 4' 'sed 1d'
prog long 'the program printed more than 25 values for as many points at k = 4' 'sed p'
prog endless 'the program printed more than 25 values for as many points at k = 4' 'yes 1'
prog status 'the program left with status 3 at k = 4' 'cat; exit 3'
prog signal 'the program was killed by signal 9 at k = 4' 'kill -9 $$'
prog words 'value 1 of the program at k = 4 is hello, not a finite number' 'sed s/.*/hello/'
prog nan 'value 2 of the program at k = 4 is nan, not a finite number' 'echo 1; echo nan; cat'
prog missing 'the program left with status 127 at k = 4' 'no-such-program'
t late 1 "" 'koksma-variation: the program printed 0 values for 81 points at k = 8' \
    'koksma-variation -d 2 --run "test ! -f ran && touch ran && koksma-eval f2 || true"'
t run-dim 1 "" \
    'koksma-variation: 17 axes have 2^17 - 1 faces, and at most 2^16 - 1 are looked at' \
    'koksma-variation --run cat -d 17'
t run-cells 1 "" \
    'koksma-variation: 65536 cells on each of 2 axes have 4.3e+09 nodes, and a program is asked for 2^28 at most' \
    'koksma-variation --run cat -d 2 --cells 2^16'

# ---- Bad input -------------------------------------------------------------------

bad() { t "$1" 1 "" "koksma-variation: $2" "$3"; }
bad faces-most '20 axes have 1048575 faces, and at most 65535, those of 16 axes, are looked at' \
    'koksma-variation sum -d 20'
bad no-grid 'standard input: 3 points are no full grid: their coordinates make one of 4 nodes' \
    'printf "0 0 1\n0 1 1\n1 0 1\n" | koksma-variation'
bad repeat 'standard input: point 4 repeats one before it: the points are no full grid' \
    'printf "0 0 1\n0 1 1\n1 0 1\n0 1 1\n" | koksma-variation'
bad value 'line 2: the value in column 2 is nan, not a finite number' \
    'printf "0 1\n1 nan\n" | koksma-variation'
bad one-node 'standard input: axis 1 has 1 nodes, and a cell takes 2' \
    'printf "0 1\n" | koksma-variation'
bad array-nan 'bad.npy: the value at node (1, 1), counted from 0, is nan, not finite' \
    'koksma-points halton -n 3 --npy | head -c 152 >bad.npy
     printf "\0\0\0\0\0\0\370\177\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0" >>bad.npy
     koksma-variation bad.npy'
bad array-cut 'standard input: the .npy array is cut short' \
    'koksma-points halton -n 9 --npy | head -c 200 | koksma-variation'

# ---- Stopped: what is printed are grids that are done --------------------------------

cat >check_stopped <<'END'
status=0; "$@" >row || status=$?
grep -v "#" row | cut -f 2,3 >stopped
read -r k v <stopped
koksma-variation f2 -a 0 -m grid -q --cells "$k" | grep -v "#" | cut -f 2,3 | diff - stopped
[ "$k" -lt 32768 ] && exit $status
END
has time 3 'stopped; the finest grid that is done has [0-9]* cells an axis' \
    'sh -e ./check_stopped koksma-variation f2 -a 0 -m grid --cells 2^15 -t 1'
has interrupt 3 'stopped; the finest grid that is done has [0-9]* cells an axis' \
    'sh -e ./check_stopped timeout --preserve-status -s INT 1 koksma-variation f2 -a 0 \
        -m grid --cells 2^15'
has stopped-program 3 '^2	[0-9]*	[0-9]*	' \
    "koksma-variation -d 2 --cells 4096 -t 1 --run 'awk \"{print (\\\$1 + \\\$2 < 1)}\"'"
# A program that says nothing is not waited for.
has silent-program 3 'koksma-variation: stopped' \
    'timeout 20 koksma-variation -d 2 -t 0.2 --run "exec sleep 60"'
has last-line-cut 0 '^2	8	3	3	3	' \
    "koksma-variation -d 2 -q --run 'awk \"{ v = v sep \\\$1 * \\\$2; sep = RS } END { printf v }\"'"
t stopped-faces 3 "" "koksma-variation: stopped" \
    'koksma-variation f2 -m grid --cells 2^15 -t 0.001 --faces 2>said
     status=$?; sed "s/;.*//" said >&2; exit $status'
t stopped-at-once 3 "" "koksma-variation: stopped; no grid is done" \
    'koksma-variation -d 2 --run "sleep 1; cat" -t 0.1'

has cells 2 'takes a power of 2, not 12' 'koksma-variation f2 --cells 12'
has run-needs-dim 2 'takes -d, the dimension' 'koksma-variation --run cat'
has run-and-file 2 'one at a time' 'koksma-variation --run cat -d 2 f2'
has two-integrands 2 'one integrand at a time, not f3 too' 'koksma-variation f2 f3'
has dim-of-file 2 '^koksma-variation: -d is for integrands, and none is named$' 'koksma-variation -d 2 </dev/null'
has method-of-file 2 '^koksma-variation: -m is for integrands, and none is named$' \
    'koksma-variation -m random --samples 5000 </dev/null'
has cells-of-file 2 '^koksma-variation: --cells is for integrands and programs' \
    'koksma-variation --cells 64 </dev/null'
has time-of-file 2 '^koksma-variation: -t is for integrands and programs' \
    'koksma-variation -t 1 </dev/null'
has method-of-program 2 '^koksma-variation: -m is for integrands, not for --run$' \
    'koksma-variation -d 2 --run cat -m boundary'
has parameter-of-program 2 '^koksma-variation: -a is for integrands, not for --run$' \
    'koksma-variation -d 2 --run cat -a zz=3'
has bounces-of-program 2 '^koksma-variation: --bounces is for integrands, not for --run$' \
    'koksma-variation -d 2 --run cat --bounces 4'
has method 2 'takes auto, grid, boundary or random, not "best"' 'koksma-variation -m best f2'
has no-range 1 'boundary cells take an integrand whose range is known' \
    'koksma-variation gaussian -m boundary'
if [ -w /dev/full ]; then
    t full-disk 1 "" \
        'koksma-variation: standard output: cannot write: No space left on device' \
        'koksma-variation f2 --cells 4 >/dev/full'
fi

rows_end
