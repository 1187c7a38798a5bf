#!/bin/sh
# koksma-star with threads, with shares and with a trace.  Rows as in cli.sh; where
# several outputs are held against each other, awk says what is wrong with them.
. "${top_srcdir:=.}/tests/cli_rows.sh"

koksma-points sobol -d 10 -n 256 >points
koksma-points random -d 3 -n 60 >few

# ---- Threads: the same answer ----------------------------------------------------

t two-threads 0 "" "" \
    'koksma-star -w -m tree -j 1 few >1; koksma-star -w -m tree -j 2 few >2; cmp 1 2'
t all-processors 0 "" "" 'koksma-star -w -m tree few >2; cmp 1 2'
t more-than-points 0 "" "" 'koksma-star -w -m tree -j 100 few >2; cmp 1 2'

# ---- The trace: it only ever narrows, down to the answer ---------------------------

# follows FILE: the rows of FILE are a trace that ends with the row in `whole`.
cat >follows <<'END'
awk -F '\t' '
function wrong(what) { print what ": " $0; exit }
NR == FNR { lower = $3; upper = $4; next }
FNR == 1 { if ($0 != "# seconds\tsteps\tlower\tupper") wrong("header"); next }
NF != 4 { wrong("columns") }
FNR > 2 && $1 < seconds { wrong("seconds fall") }
FNR > 2 && $2 < steps { wrong("steps fall") }
FNR > 2 && $3 < low { wrong("lower falls") }
FNR > 2 && $4 > high { wrong("upper rises") }
FNR > 2 && $3 == low && $4 == high { wrong("nothing new") }
{ seconds = $1; steps = $2; low = $3; high = $4; rows++ }
END { if (rows < 2 || low != lower || high != upper) print "ends with " low, high }
' whole "$1"
END
for threads in 1 2; do
    t "trace-$threads" 0 "" "" \
        "koksma-star -q -m tree few >whole; koksma-star --trace -m tree -j $threads few >trace
         sh ./follows trace"
done
t trace-sweep 0 "" "" 'koksma-star -q -m sweep few >whole
    koksma-star --trace -m sweep few | sed "2i0\t0\t0\t1" >trace; sh ./follows trace'
has trace-share 0 '^# seconds	steps	part_lower	part_upper$' \
    'koksma-star --trace --part 1/3 few'
t trace-sets 0 "# input${tab}seconds${tab}steps${tab}lower${tab}upper
1
2" "" '{ cat few; echo; cat few; } | koksma-star --trace | sed "1!s/\t.*//" | uniq'

t trace-full 1 "" "koksma-star: standard output: cannot write: No space left on device" \
    'koksma-star --trace few >/dev/full'
t no-header 1 "" "koksma-star: points: filtered lines take 2 or 3 coordinates, not 10" \
    'koksma-star -m lines points'

has why-sweep 0 'sweep (few corners)' 'koksma-points random -d 3 -n 5 | koksma-star -v'
has why-tree 0 'tree (more than three coordinates)' 'koksma-star -v points'
has why-told 0 'tree (as told)' 'koksma-star -v -m tree few'

t stages 0 " 8 4 2 1.5 1.25 1.1 1.05 1" "" "koksma-points sobol -d 5 -n 128 |
    koksma-star --trace -m tree -j 1 |
    awk '\$4 < 1 { printf \" %g\", \$4 / \$3 } END { print \"\" }'"

# ---- Prefixes: each as a set of its own -----------------------------------------------

t prefixes 0 "" "" '
    koksma-star -q --prefixes 7,10:60 few >prefixes
    for n in 7 10 20 40 60; do grep -v "#" few | head -n $n | koksma-star -q; done | diff prefixes -'
has prefixes-too-many 1 'set .* has 60 points, and --prefixes asks for 61' \
    'koksma-star --prefixes 8,61 few'
has prefixes-fall 2 'takes numbers that rise' 'koksma-star --prefixes 8,7 few'

# ---- Shares: together they are the whole, and none is much more than its part -------

# Four processes at once.  How much work each was is told in its steps: in seconds it
# would depend on what else the machine is doing.
sh -c 'koksma-star -q -v -j 1 points >whole 2>whole.said
for i in 1 2 3 4; do
    koksma-star -q -v -j 1 --part $i/4 points >part$i 2>part$i.said &
done
wait'
for name in whole part1 part2 part3 part4; do
    sed 's/.*), \([^ ]*\) .*/\1/' $name.said >$name.steps
done
t parts-make-the-whole 0 "" "" 'cat part[1-4] | awk -F "\t" "
    \$3 > lower { lower = \$3; low = \$0 }
    \$4 > upper { upper = \$4; high = \$0 }
    END { print low; print high }" | uniq | diff whole -'
t parts-share-the-work 0 "5" "" 'cat whole.steps part[1-4].steps | awk "
    NR == 1 { whole = \$1; next }
    \$1 > 0.4 * whole { print \"part \" NR - 1 \" takes \" \$1 \" of \" whole }
    END { print NR }"'
t part-header 0 "# n${tab}dim${tab}part_lower${tab}part_upper" "" \
    'koksma-star --part 2/3 few | head -n 1'
t part-of-one 0 "" "" 'koksma-star -j 1 few >1; koksma-star --part 1/1 few >2; cmp 1 2'

# ---- Bad command lines -------------------------------------------------------------

try="
Try 'koksma-star -h'."
bad_part() {
    t "part $1" 2 "" "koksma-star: --part takes $2, not \"${3-$1}\"$try" "koksma-star --part '$1' few"
}
bad_part 3 'two numbers like 2/8'
bad_part '' 'two numbers like 2/8'
bad_part 0/4 'a whole number from 1 to 4' 0
bad_part 5/4 'a whole number from 1 to 4' 5
bad_part 1/0 'a whole number from 1 to 1000000' 0
bad_part 1/ 'a whole number from 1 to 1000000' ''
bad_part /2 'a whole number from 1 to 2' ''
bad_part 1/2/3 'a whole number from 1 to 1000000' 2/3
bad_part -1/2 'a whole number from 1 to 2' -1
bad_part 1/2x 'a whole number from 1 to 1000000' 2x
bad_part 1.5/2 'a whole number from 1 to 2' 1.5
for method in sweep dem search; do
    t "part-of-$method" 2 "" \
        "koksma-star: --part takes the tree or the lines: the others cannot be cut$try" \
        "koksma-star -m $method --part 1/2 few"
done
t trace-witness 2 "" "koksma-star: --trace has no room for a witness$try" \
    'koksma-star --trace -w few'
t threads-word 2 "" \
    "koksma-star: -j takes a whole number from 0 to 65536, not \"two\"$try" \
    'koksma-star -j two few'

rows_end
