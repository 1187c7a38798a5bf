#!/bin/sh
# koksma-box.  Rows as in cli.sh.
. "${top_srcdir:=.}/tests/cli_rows.sh"

t one-point 0 "# n${tab}dim${tab}lower${tab}upper
1${tab}2${tab}1${tab}1" "" 'echo .5 .5 | koksma-box'
t witness 0 "# n${tab}dim${tab}lower${tab}upper${tab}box${tab}inside${tab}corners
2${tab}1${tab}0.5${tab}0.5${tab}closed${tab}1${tab}0.25${tab}0.25" "" \
    'printf ".75\n.25\n" | koksma-box -w'
t open-witness 0 "2${tab}2${tab}1${tab}1${tab}open${tab}0${tab}0${tab}0${tab}1${tab}1" "" \
    'printf "0 0\n1 1\n" | koksma-box -qw'
t several 0 "1${tab}1${tab}1${tab}1${tab}1
2${tab}2${tab}1${tab}0.5${tab}0.5" "" 'printf ".5\n\n.25\n.75\n" | koksma-box -q'

koksma-points random -d 2 -n 200 >points
koksma-points halton -d 3 -n 60 >space

t methods-agree 0 "" "" 'koksma-box -w -m sweep points >1; koksma-box -w -m tree points >2
    koksma-box -w points >3; cmp 1 2; cmp 1 3'
for threads in 1 2 5; do
    t "threads-$threads" 0 "" "" \
        "koksma-box -w -j $threads points >2; cmp 1 2; koksma-box -w -j $threads -m sweep points | cmp 1 -"
done
t prefixes 0 "" "" 'koksma-box -q --prefixes 7,10:40 space >prefixes
    for n in 7 10 20 40; do grep -v "#" space | head -n $n | koksma-box -q; done | diff prefixes -'
t parts 0 "" "" 'koksma-box -q space >whole
    for i in 1 2 3; do koksma-box -q --part $i/3 space; done | awk -F "\t" "
    \$3 > lower { lower = \$3; low = \$0 }
    \$4 > upper { upper = \$4; high = \$0 }
    END { print low; print high }" | uniq | diff whole -'
t part-header 0 "# n${tab}dim${tab}part_lower${tab}part_upper" "" \
    'koksma-box --part 2/3 space | head -n 1'
t trace 0 "" "" 'koksma-box -q space >whole; koksma-box --trace space | tail -n 1 |
    cut -f 3,4 >last; cut -f 3,4 whole | cmp - last'
t tolerance 0 "" "" 'koksma-box -q -e .5 space | awk "!(\$3 <= \$4 && \$4 <= 1.500001 * \$3)"'
has search 0 '^60	3	0\.[0-9]*	1$' 'koksma-box -q -m search -s 3 space'
has verbose 0 'tree (more than two coordinates), .* list entries' 'koksma-box -v space'
has time-limit 3 '^2000	4	0\.' 'koksma-points random -d 4 -n 2000 | koksma-box -q -t .2'

try="
Try 'koksma-box -h'."
t method 2 "" "koksma-box: -m takes auto, sweep, tree or search, not \"dem\"$try" \
    'koksma-box -m dem points'
t part-of-search 2 "" \
    "koksma-box: --part takes the sweep or the tree: the search cannot be cut$try" \
    'koksma-box -m search --part 1/2 points'
t sweep-in-space 1 "" "koksma-box: space: the sweep takes 1 or 2 coordinates, not 3" \
    'koksma-box -m sweep space'
t outside 1 "" "koksma-box: line 2: coordinate 1 is 1.5, not in [0,1]" \
    'printf ".5\n1.5\n" | koksma-box'

rows_end
