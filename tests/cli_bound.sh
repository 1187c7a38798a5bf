#!/bin/sh
# koksma-bound over what the other tools print, and the saturation that koksma-fit
# knows.  Rows as in cli.sh.
. "${top_srcdir:=.}/tests/cli_rows.sh"

koksma-points halton -n 2^10 | koksma-star --prefixes 2^8:2^10 >star
koksma-variation ball -d 3 --cells 32 >diverging
koksma-variation gaussian --cells 64 >grid
koksma-cells ball -d 3 -n 2^12 >cells

# ---- One N -----------------------------------------------------------------------

t f2 0 "# koksma: integrand=f2 dim=2 n_sat=4 n_even=0.8888888888888891
# N${tab}term${tab}value${tab}kind${tab}note
4096${tab}koksma-hlawka${tab}inf${tab}proved${tab}-
4096${tab}smooth${tab}0${tab}proved${tab}-
4096${tab}paper${tab}0.0027621358640099515${tab}one-sigma${tab}-
4096${tab}jump${tab}0.0009482261166158661${tab}one-sigma${tab}-
4096${tab}rms${tab}0.0009482261166158661${tab}one-sigma${tab}-
4096${tab}reach${tab}0.0018964522332317322${tab}estimate${tab}-
4096${tab}random${tab}0.0078125${tab}one-sigma${tab}-" "" 'koksma-bound f2 -n 2^12'
t told 0 "16 koksma-hlawka 0.75 proved
16 smooth 0.25 one-sigma
16 paper nan unknown
16 jump 0.03125 one-sigma
16 rms 0.251946 one-sigma
16 reach 0.755837 estimate
16 random 0.25 one-sigma" "" \
    'koksma-bound -d 2 -q -n 16 --star .25 --vhk 3 --smooth 4 --jump 1 --area .375 \
         --sigma 1 --reach 3 | awk "{ print \$1, \$2, \$3 + 0 == \$3 ? sprintf(\"%g\", \$3) : \$3, \$4 }"'
t star-curve 0 "256 proved
512 proved
1024 proved" "" \
    'koksma-bound gaussian star -q | awk "/hlawka/ { print \$1, \$4 }"'
t worst-of-sets 0 "8 0.5" "" \
    'printf "# n dim lower upper\n8 2 .25 .25\n8 2 .5 .5\n8 2 .125 .125\n" >sets
     koksma-bound -d 2 --vhk 1 sets -q | awk "/hlawka/ { print \$1, \$3 }"'
t options-first 0 "0.25" "" \
    'koksma-bound -d 3 cells --extent 4 --jump 1 --sigma 9 --area 1.5 --axes 1 --smooth-vhk 0 -q -n 2 |
     awk "/jump/ { print \$3 }"'
t product 0 "" "" \
    'koksma-bound product -d 2 star -q | awk "/hlawka/ { print \$1, \$3 / 3 }" >1
     awk "!/#/ { print \$1, \$4 / 1 }" star | diff - 1'
t grid 0 "256${tab}estimate${tab}variation>=3.58766,k=64" "" \
    'koksma-bound -d 2 star grid -q | awk "/hlawka/" | head -n 1 | cut -f 1,4,5'
t diverging 0 "64${tab}koksma-hlawka${tab}nan${tab}diverging${tab}rate=1.6,k=32" "" \
    'koksma-bound diverging cells -q -n 64 | head -n 1 | sed "s/rate=1.[0-9]*/rate=1.6/"'
t from-cells 0 "" "" \
    'koksma-bound -d 3 cells --sigma .4 --smooth-vhk 0 -n 64:2^12 -q >1
     koksma-bound ball -d 3 --sigma .4 -n 64:2^12 -q | grep -v hlawka >2
     grep -v hlawka 1 | diff - 2'
t usual-points 0 "16 1048576" "" \
    'koksma-bound f2 -q | cut -f 1 | uniq | sed -n "1p;\$p" | paste -s -d " " -'

# ---- Beside what was observed ------------------------------------------------------

koksma-points halton -n 2^12 --scramble digits --replicates 16 | koksma-eval f2 |
    koksma-error >rows
koksma-error --summary --exact .5 >summary <<END
0 0
1 1
1 1
1 1
END
t observed 0 "" "" \
    'koksma-bound f2 --observe rows -q | awk "\$1 == 4096 && \$2 == \"jump\" &&
         !(\$6 > .5 && \$6 < 1.6 && (\$5 / \$3 / \$6 - 1) ^ 2 < 1e-20)"'
t observed-summary 0 "1 0.5
4 0.25" "" \
    'koksma-bound f2 --observe summary -q | awk "/random/ && \$1 != 2 && \$1 != 3 { print \$1, \$5 }"'
has unscrambled 0 '	not-scrambled$' \
    'koksma-points halton -n 64 | koksma-eval f2 | koksma-error | koksma-bound f2 --observe -'
t facts-from-comments 0 "" "" \
    'koksma-bound --observe rows --smooth-vhk 0 -q | sed 1d | grep -v hlawka >1
     koksma-bound f2 --observe rows -q | sed 1d | grep -v hlawka >2; cmp 1 2'

# ---- In words --------------------------------------------------------------------

has says-nothing 0 'says nothing: the variation is infinite' 'koksma-bound f2 --explain'
has says-rate 0 'diverges at rate 1[.0-9]* up to k = 32' \
    'koksma-bound diverging cells --explain'
has proves 0 'proves an error of 0.0[0-9]* at most' 'koksma-bound product star --explain'
has pays 0 'At N = 4096 quasi-Monte Carlo can pay: its error is 8.2 times' \
    'koksma-bound f2 -n 2^12 --explain'
has pays-smooth 0 'quasi-Monte Carlo pays: there is no jump' 'koksma-bound product --explain'
has cannot-pay 0 'At N = 1.049e+06 quasi-Monte Carlo cannot pay' \
    'koksma-cells sphere --bounces 5 >l; koksma-bound sphere --bounces 5 l --explain'
has not-known 0 'is not known from this' 'koksma-bound -d 2 --explain'

# ---- Below the saturation koksma-fit decides nothing -------------------------------

for bounces in 5 10; do
    koksma-points halton -d $((2 * bounces)) -n 2^12 --scramble digits --replicates 32 |
        koksma-eval sphere --bounces $bounces | koksma-error >"errors$bounces"
    koksma-cells sphere --bounces $bounces -q |
        awk -v d=$((2 * bounces)) '{ print $10 ^ d }' >"saturation$bounces"
    has saturated-$bounces 0 "	undecided	saturated	" \
        "koksma-fit --saturation \$(cat saturation$bounces) --margin .2 errors$bounces"
    has saturated-words-$bounces 0 '^Saturated: nearly every cell meets the jump up to about N = ' \
        "koksma-fit --saturation \$(cat saturation$bounces) --explain errors$bounces"
done
has saturated-by-comment 0 '	undecided	saturated	' \
    'koksma-points halton -d 6 -n 2^10 --scramble digits --replicates 32 |
     koksma-eval ball -a .5 | koksma-error | sed "1s/extent=[^ ]*/extent=9/" | koksma-fit'
has axes-by-comment 0 '	wide	\|	bent	\|	-	\|	rival	' \
    'koksma-points halton -d 6 -n 2^10 --scramble digits --replicates 32 |
     koksma-eval ball -a .5 | koksma-error | sed "1s/extent=[^ ]*/extent=9 axes=2/" | koksma-fit'
has told-otherwise 0 '	wide	\|	bent	\|	-	\|	rival	' \
    'koksma-fit --saturation 0 --margin .2 errors5'

# ---- Bad input -------------------------------------------------------------------

bad() { t "$1" 1 "" "koksma-bound: $2" "$3"; }
bad no-table 'rows: no table of koksma-star, koksma-variation or koksma-cells, under the line that names its columns' \
    'koksma-bound f2 rows'
bad no-errors 'star: no table of koksma-error, under the line that names its columns' \
    'koksma-bound f2 --observe star'
bad no-file 'nowhere: No such file or directory' 'koksma-bound f2 nowhere'
bad empty 'standard input: no table of koksma-star, koksma-variation or koksma-cells, under the line that names its columns' \
    'koksma-bound f2 - </dev/null'
bad other-dim 'star: 2 coordinates, but the integrand has 3' 'koksma-bound f3 star'
bad word 'w:2: column 2 is x, not a finite number' \
    'printf "# n upper\n8 x\n" >w; koksma-bound f2 w'
bad l2 'w: a table of koksma-l2, which does not bound D*' \
    'echo 1 1 | koksma-l2 >w; koksma-bound sum w'
bad edge 'w: a table of koksma-edge, which does not bound D*' \
    'echo 1 1 | koksma-edge -w >w; koksma-bound -d 2 --vhk 1 w'
t box 0 "3 proved" "" \
    'echo 1 1 | koksma-box | koksma-bound product - -q | head -n 1 | cut -f 3,4 | tr "\t" " "'
bad other-observed 'rows: of f2, not of gaussian' 'koksma-bound gaussian --observe rows'
bad other-variation 'grid: of gaussian, not of oscillatory' \
    'koksma-bound oscillatory grid star'
bad other-cells 'cells: of ball, not of f3' 'koksma-bound f3 cells'
bad of-each-other 'rows: of f2, not of gaussian' 'koksma-bound grid --observe rows'
bad other-parameter 'rows: a is 0, but the integrand has 0.25' \
    'koksma-bound f2 -a .25 --observe rows'
bad other-odd 'odd: of a?b, not of f2' \
    'printf "# koksma: integrand=a\033b\n# N error\n4 .1\n" >odd; koksma-bound f2 --observe odd'
bad other-bounces 'w: 4 coordinates, but the integrand has 6' \
    'koksma-cells sphere --bounces 2 --lines 50 >w; koksma-bound sphere --bounces 3 w'
bad other-piece 'standard input: of the smooth piece of f2 alone' \
    'koksma-points halton -n 9 | koksma-eval f2 --piece smooth | koksma-error |
     koksma-bound f2 --observe -'
t own-integrand 0 "0.25" "" \
    'printf "# koksma: integrand=disc dim=2 sigma=.5\n# N error\n4 .1\n" >own
     koksma-bound --observe own -q | awk "/random/ { print \$3 }"'
bad axes 'the surface depends on 3 axes, and there are 2' 'koksma-bound f2 --axes 3'
has no-dim 2 'name an integrand, or say the dimension by -d' 'koksma-bound'
has star-alone 2 '^koksma-bound: --star takes -n with the one N that it is D\* of' \
    'koksma-bound f2 --star .1'
has negative 2 '^koksma-bound: --area takes a number from 0 to' 'koksma-bound f2 --area -1'
has nameless 2 'are for integrands, and none is named' 'koksma-bound -a 1 -d 2'
if [ -w /dev/full ]; then
    t full-disk 1 "" \
        'koksma-bound: standard output: cannot write: No space left on device' \
        'koksma-bound f2 >/dev/full'
fi

rows_end
