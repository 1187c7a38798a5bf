#!/bin/sh
# koksma-edge as its users meet it.  Rows as in cli.sh.
. "${top_srcdir:=.}/tests/cli_rows.sh"

koksma-points random -n 300 >few

t corner 0 "# koksma: measure=edge
# n${tab}dim${tab}lower${tab}upper
1${tab}2${tab}0.9999999999999999${tab}1" "" 'echo 1 0 | koksma-edge'
t witness 0 "# koksma: measure=edge
# n${tab}inside${tab}from_x${tab}from_y${tab}to_x${tab}to_y
1${tab}1${tab}0.5${tab}0${tab}0${tab}0.25" "" 'echo .25 .125 | koksma-edge -w | cut -f 1,5-'
t left-of-it 0 "8${tab}6${tab}6" "" \
    'koksma-points halton -n 8 --start 1 >p; koksma-edge -q -w p | tr "\t" " " >w
     grep -v "#" p | awk "NR == FNR { a = \$6; b = \$7; c = \$8; d = \$9; n = \$1; m = \$5; next }
         (c - a) * (\$2 - b) - (d - b) * (\$1 - a) > -1e-9 { k++ }
         END { print n \"\t\" m \"\t\" k }" w -'
t several 0 "# koksma: measure=edge
# input${tab}n${tab}dim
a:1${tab}1${tab}2
a:2${tab}2${tab}2
1${tab}1${tab}2" "" 'printf "0 0\n\n0 1\n1 1\n" >a; echo .5 .5 | koksma-edge a - | cut -f 1-3'
t methods 0 "" "" \
    'koksma-edge -w -m sweep few >1; koksma-edge -w -m tree few >2; cmp 1 2'
t threads 0 "" "" \
    'koksma-edge -w -j 1 few >1; koksma-edge -w -j 3 few >2; koksma-edge -w few >3
     cmp 1 2; cmp 1 3'
t prefixes 0 "" "" '
    koksma-edge -q --prefixes 7,10:300 few >prefixes
    for n in 7 10 20 40 80 160 300; do grep -v "#" few | head -n $n | koksma-edge -q; done |
        diff prefixes -'
t tolerance 0 "1" "" 'koksma-edge -q -m tree -e 0.5 few | awk "{ print \$4 <= 1.5001 * \$3 }"'
t trace 0 "" "" 'koksma-edge -q few >whole; koksma-edge --trace few | tail -n 1 |
    cut -f 3,4 >last; cut -f 3,4 whole | cmp - last'
t nothing-odd 0 "" "" 'koksma-edge -q few >1; koksma-edge -q -p few >2; cmp 1 2'
has why-sweep 0 'sweep (few points)' 'echo .5 .5 | koksma-edge -v'
has why-tree 0 'tree (many points)' 'koksma-edge -v few'
has why-told 0 'sweep (as told)' 'koksma-edge -v -m sweep few'
has version 0 '^koksma-edge (koksma) [0-9]' 'koksma-edge --version'
has time 3 '^1000000	2	[0-9]' 'koksma-points halton -n 1e6 | koksma-edge -q -t 0.01'

t three 1 "" 'koksma-edge: standard input: half-planes take 2 coordinates, not 3' \
    'echo .1 .2 .3 | koksma-edge'
t outside 1 "" 'koksma-edge: line 2: coordinate 1 is 2, not in [0,1]' \
    'printf "0 0\n2 0\n" | koksma-edge'
has method 2 '^koksma-edge: -m takes auto, sweep or tree, not "best"$' 'koksma-edge -m best few'
has trace-witness 2 '^koksma-edge: --trace has no room for a witness$' \
    'koksma-edge --trace -w few'
has tolerance-word 2 '^koksma-edge: -e takes ' 'koksma-edge -e much few'
[ ! -w /dev/full ] || t full-disk 1 "" \
    'koksma-edge: standard output: cannot write: No space left on device' \
    'koksma-edge few >/dev/full'

rows_end
