#!/bin/sh
# The tools as their users meet them: each row is a command, and what it must
# print on both outputs and return.
. "${top_srcdir:=.}/tests/cli_rows.sh"

head="# n${tab}dim${tab}lower${tab}upper"

# ---- What people do ------------------------------------------------------------

t one-point 0 "$head
1${tab}2${tab}0.75${tab}0.75" "" 'echo .5 .5 | koksma-star'
t witness 0 "$head${tab}box${tab}inside${tab}corner
1${tab}2${tab}0.75${tab}0.75${tab}closed${tab}1${tab}0.5${tab}0.5" "" \
    'echo .5 .5 | koksma-star -w'
t search 0 "1${tab}2${tab}0.75${tab}1${tab}closed${tab}1${tab}0.5${tab}0.5" "" \
    'echo .5 .5 | koksma-star -m search -s 7 -q -w'
t on-the-faces 0 "2${tab}2${tab}1${tab}1" "" 'printf "0 0\n0 1\n" | koksma-star -q'
t forms-of-text 0 "3${tab}2${tab}0.41666666666666663${tab}0.4166666666666667" "" \
    'printf "# x y\r\n  0x.8p0,0.5\r\n .25\t25e-2 # here\r\n1 , 1" | koksma-star -q'
t two-sets 0 "# input${tab}n${tab}dim${tab}lower${tab}upper
1${tab}1${tab}2${tab}0.75${tab}0.75
2${tab}1${tab}1${tab}0.5${tab}0.5" "" 'printf "\n.5 .5\n\n\n.5\n\n" | koksma-star'
t two-files 0 "a:1${tab}1${tab}1${tab}0.5${tab}0.5
-:1${tab}1${tab}1${tab}1${tab}1" "" \
    'echo .5 >a; cp a ./-; echo 1 >./-; koksma-star -q a ./- | sed "s|^\./||"'
t second-opinion 0 "" "" \
    'koksma-points halton -d 4 -n 200 >p; koksma-star -w -m tree p >1
     koksma-star -w -m dem p >2; cmp 1 2'
has what-was-done 0 'dem (as told), [0-9.e+]* products' \
    'koksma-points halton -d 3 -n 50 | koksma-star -m dem -v'
t points 0 "# koksma-points halton -n 3 -d 2
# koksma: points=halton scramble=none
0${tab}0
0.5${tab}0.3333333333333333
0.25${tab}0.6666666666666666" "" 'koksma-points halton -n 3 -d 2'
t start 0 "0.25${tab}0.6666666666666666" "" 'koksma-points halton -n 1 --start 2 -q'
t bases 0 "0.3333333333333333${tab}0.19999999999999998" "" \
    'koksma-points halton --bases 3,5 -n 1 --start 1 -q'
t hex 0 "0x1p-1${tab}0x1.5555555555555p-2" "" \
    'koksma-points halton -n 1 --start 1 -q --hex'
t sobol 0 "0${tab}0
0.5${tab}0.5
0.75${tab}0.25" "" 'koksma-points sobol -n 4 -q | head -n 3'
t grid 0 "0${tab}0
0${tab}0.5
0.5${tab}0
0.5${tab}0.5" "" 'koksma-points grid -n 2^2 -q'
t npy-pipe 0 "1000${tab}3${tab}x" "" \
    'koksma-points random -d 3 -n 1e3 --npy >p.npy
     koksma-points random -d 3 -n 1e3 >p.txt
     koksma-star -q p.npy >1; koksma-star -q p.txt >2; cmp 1 2 && cut -f 1,2 1 | sed "s/$/\tx/"'
t eval 0 "# koksma: integrand=f2 dim=2 a=0.25 exact=0.5 variance=0.11458333333333334 area=1.4142135623730951 jump=0.5 extent=2
# x1${tab}x2${tab}f2
0.5${tab}0.5${tab}0.25
0.5${tab}0.75${tab}0.8125" "" 'printf "0.5 0.5\n0.5 .75\n" | koksma-eval f2 -a .25'
t eval-own-dim 0 "# koksma: integrand=ball dim=3 r=0.25 exact=0.06544984694978735 variance=0.06116616448403676 area=0.7853981633974483 jump=1 extent=1.1780972450961724
# x1${tab}x2${tab}x3${tab}ball
0.5${tab}0.5${tab}0.75${tab}1" "" 'echo 0.5 0.5 .75 | koksma-eval ball -a r=.25'
t eval-two-parameters 0 "0.5${tab}0.5${tab}4" "" 'echo .5 .5 | koksma-eval product-peak -q -a w=.5 -a c=1 -a 2 |
     awk "{ print \$1 \"\t\" \$2 \"\t\" sqrt(\$3) }"'
t eval-no-parameter 0 "# koksma: integrand=sum dim=1 exact=0.5 variance=0.08333333333333333
# x1${tab}sum
0.5${tab}0.5" "" 'echo .5 | koksma-eval sum'
t eval-list 0 "box${tab}3${tab}c=0.5${tab}0.125" "" 'koksma-eval --list box -d 3 -a .5 -q | cut -f 1-4'
t eval-list-all 0 "22" "" 'koksma-eval --list -q | wc -l | tr -d " "'
t eval-list-dim 0 "1" "" 'koksma-eval --list -d 3 | grep -c "^f3"'
t scene 0 "# koksma: integrand=sphere dim=4 bounces=2 albedo=0.5 cap=0.2 height=1 azimuth=1.1 exact=0.05 neumann=0.2 variance=0.010000000000000002 jump=0.25 axes=3
# x1${tab}x2${tab}x3${tab}x4${tab}sphere
1${tab}0${tab}0${tab}0${tab}0.25" "koksma-eval: under-resolved: 1 of 1 walks hit" \
    'echo 1 0 0 0 | koksma-eval sphere --bounces 2 --albedo 0.5 --cap 0.2 -a height=1'
t scene-resolved 0 "" "" 'koksma-points halton -n 128 | koksma-eval sphere >/dev/null'
t scene-sets 0 "" "koksma-eval: under-resolved: 1 of 2 sets have fewer than 10 hits; in one of them 0 of 1 walks hit" \
    '{ koksma-points halton -n 128; echo; echo 0 0; } | koksma-eval sphere >/dev/null'
t error 0 "# koksma: integrand=f2 dim=2 a=0 exact=0.5 variance=0.25 area=1.4142135623730951 jump=1 extent=2 sigma=0.5 sigma_from=variance largest=1
# set${tab}N${tab}error${tab}tail${tab}mc
1${tab}1${tab}-0.5${tab}0.5${tab}0.5
1${tab}2${tab}0${tab}0.16666666666666666${tab}0.35355339059327373
1${tab}3${tab}0.16666666666666666${tab}0.16666666666666666${tab}0.2886751345948129
1${tab}4${tab}0${tab}0${tab}0.25" "" \
    'printf "0 0\n1 1\n1 1\n0 0\n" | koksma-eval f2 | koksma-error'
t error-told 0 "1${tab}1${tab}-0.75${tab}0.75${tab}0.75" "" \
    'echo 0.1 .25 | koksma-error --exact 1 -q'
t error-variance 0 "1${tab}4${tab}0.25${tab}0.25${tab}1.5" "" \
    'printf "# koksma: variance=9\n0 1\n0 1\n0 -2\n0 1\n" |
     koksma-error --exact 0 --prefixes 4 -q'
t error-prefixes 0 "1${tab}3
1${tab}4
1${tab}8
1${tab}16
1${tab}20" "" \
    'koksma-points halton -n 50 | koksma-eval f2 |
     koksma-error --prefixes 3,2^2:20 --steps 1 -q | cut -f 1,2'
t error-mean 0 "1${tab}1${tab}-0.5${tab}0.5${tab}0.5
2${tab}1${tab}0.5${tab}0.5${tab}0.5" "" \
    'printf "0 0\n0 1\n0 0\n0 1\n\n0 1\n0 0\n0 1\n0 0\n" | koksma-error --exact mean -q'
t fit-one-path 0 "power${tab}-1${tab}nan${tab}nan${tab}nan${tab}nan${tab}none${tab}path${tab}-1/2=nan;-1=nan${tab}-" "" \
    'printf "16 4\n64 1\n256 .25\n" | koksma-fit -x 1 -y 2 -q | cut -f 1-10'
t fit-box 0 "1.5 3 2 8" "" \
    'printf "# k K\n2 8\n4 22.627416997969522\n8 64\n" | koksma-fit -x k -y K -q |
     awk "{ print 0 + sprintf(\"%.9f\", \$2), \$23, \$25, \$26 }"'
t fit-even 0 "0.25" "" \
    'printf "16 4\n64 1\n256 .25\n" |
     koksma-fit -x 1 -y 2 -q -d 2 --area 3 --jump 1 --sigma 1 | cut -f 21'
has star-curve 0 '^power	-0\.' \
    'for n in 64 128 256 512; do koksma-points halton -n $n; echo; done | koksma-star |
     koksma-fit'
t path-of-many 0 "" "" \
    'koksma-points random -n 2^10 --replicates 3 | koksma-eval f2 | koksma-error >e
     koksma-fit --path 2 -q e >1; grep -v "^[13]" e | koksma-fit -q >2; cmp 1 2'
has path-said 0 '^It is set 3 alone.  This is one path' 'koksma-fit --path 3 --explain e'
has replicates-said 0 '^Replicates give one: koksma-points' 'koksma-fit --path 3 --explain e'
t explain-star 0 "From N = 64 to 256 (3 of them) the error goes like 64 N^s with s = -1.0000.
This is one path: its errors hang together, and no honest interval can be
had from it." "" \
    'printf "# n upper\n64 1\n128 .5\n256 .25\n" | koksma-fit --explain'
has claim 0 '	-0.5	equivalent	-	claim=' \
    'koksma-points random -n 2^13 --replicates 64 -s 5 | koksma-eval f2 | koksma-error |
     koksma-fit --claim -0.5 --margin 0.2'
t power-in-window 0 "" "" \
    'printf "16 4\n64 1\n256 .25\n" | koksma-fit -x 1 -y 2 -q --from 2^4 >/dev/null'
has slope 0 '^Verdict: equivalent to -(D+1)/2D = -0.75, within 0.1' \
    'koksma-points halton -n 2^13 --scramble digits --replicates 64 | koksma-eval f2 |
     koksma-error | koksma-fit --explain --margin 0.1'
has summary 0 "^64${tab}.*${tab}8${tab}0.0625\$" \
    'koksma-points halton -n 64 --scramble digits --replicates 8 | koksma-eval f2 |
     koksma-error --summary'
t same-bits 0 "" "" \
    'koksma-points halton --scramble digits --replicates 2 -n 300 | sed 1,2d >a
     koksma-points halton --scramble digits --replicates 2 -n 100 | sed "1,2d;/^$/,\$d" |
     diff - a | grep "^<"; true'
has version 0 '^koksma-star (koksma) [0-9]' 'koksma-star --version'
has help 0 '^  -w, --witness' 'koksma-star -h'
has list 0 "^sobol${tab}1-1111${tab}-${tab}digital" 'koksma-points --list'
t list-one 0 "halton${tab}any" "" 'koksma-points halton --list -q | cut -f 1,2'

# ---- Bad input: a sentence with file, line and field, and no result --------------

bad() { t "$1" 1 "" "koksma-star: $2" "$3 | koksma-star"; }
bad nan 'line 1: coordinate 2 is nan, not in [0,1]' 'echo 0 nan'
bad inf 'line 2: coordinate 1 is inf, not in [0,1]' 'printf "0\ninf\n"'
bad above 'line 3: coordinate 3 is 1.5, not in [0,1]' 'printf "#\n0 0 0\n1 1 1.5\n"'
bad below 'line 1: coordinate 1 is -1e-300, not in [0,1]' 'echo -1e-300'
bad ragged 'line 2: 1 column, but the first line of the set has 2' 'printf "0 1\n0\n"'
bad long 'line 2: more than the 2 columns of the first line of the set' \
    'printf "0 1\n0 0 0\n"'
bad word 'line 1: column 2 is hello, not a number' 'echo 0 hello'
bad tail 'line 1: column 1 is 0.5x, not a number' 'echo 0.5x'
bad hole 'line 1: column 2 is empty, not a number' 'echo 0,,0'
bad nul 'line 1: a NUL byte: this is not text' 'printf "0 0\\0 0\n"'
bad empty 'standard input: no point set in it' 'true'
bad header 'standard input: no point set in it' 'echo "# n dim"'
bad npy-cut 'standard input: the .npy array is cut short' \
    'koksma-points halton -n 9 --npy | head -c 200'
bad npy-type 'standard input: the .npy array is of type '"'<i8': only float64 and float32 are read" \
    'koksma-points halton -n 9 --npy | sed "s/<f8/<i8/"'
t file-and-line 1 "" 'koksma-star: bad.txt:2: coordinate 1 is 2, not in [0,1]' \
    'printf "0\n2\n" >bad.txt; koksma-star bad.txt'
t no-file 1 "" 'koksma-star: nowhere: No such file or directory' 'koksma-star nowhere'
t directory 1 "" 'koksma-star: .: Is a directory' 'koksma-star .'
t later-set 1 "1${tab}1${tab}1${tab}0.5${tab}0.5
2${tab}1${tab}1${tab}0.5${tab}0.5" 'koksma-star: line 5: coordinate 1 is 7, not in [0,1]' \
    'printf ".5\n\n.5\n\n7\n" | koksma-star -q'
t eval-dim 1 "" 'koksma-eval: set 1 has 3 coordinates a point, but f2 takes 2' \
    'echo 0 0 0 | koksma-eval f2'
t eval-line 1 "" 'koksma-eval: set 1 has 1 coordinate a point, but f2 takes 2' \
    'echo 0 | koksma-eval f2'
t eval-dims 1 "" 'koksma-eval: set 1 has 3 coordinates a point, but sphere takes from 2 to 2000, an even number' \
    'echo 0 0 0 | koksma-eval sphere'
t eval-bounces 1 "" 'koksma-eval: set 1 has 2 coordinates a point, but sphere takes 4' \
    'echo 0 0 | koksma-eval sphere --bounces 2'
t eval-sets-differ 1 "0${tab}0${tab}0" \
    'koksma-eval: set 2 has 3 coordinates a point, but the first set 2' \
    'printf "0 0\n\n0 0 0\n" | koksma-eval sum -q'
t no-exact 1 "" \
    'koksma-error: the input does not say the exact integral: give --exact VALUE' \
    'echo 0 1 | koksma-error'
t exact-nan 1 "" 'koksma-error: the input says exact=nan, which is no finite number' \
    'printf "# koksma: exact=nan\n0 1\n" | koksma-error'
has two-integrands 1 'set other:1 is of another integrand than the first; a table is of one' \
    'koksma-points halton -n 8 >p; koksma-eval f2 p >one; koksma-eval gaussian p >other
     koksma-error one other'
t no-minus-zero 0 "1${tab}2${tab}1${tab}1${tab}closed${tab}1${tab}0${tab}0" "" \
    'echo -0. -0 | koksma-star -w -q -m sweep'
t no-value 1 "" 'koksma-error: line 1: 1 column, but a point and its value take at least 2' \
    'echo 1 | koksma-error --exact 0'
t unequal 1 "" \
    'koksma-error: set 2 has 2 values, the first set 1: --summary takes equal ones' \
    'printf "0 1\n\n0 1\n0 1\n" | koksma-error --exact 0 --summary'
t fit-column 1 "" 'koksma-fit: standard input: no column is called error, rms or upper; say which by -y' \
    'printf "# N err\n1 1\n" | koksma-fit'
t fit-no-names 1 "" 'koksma-fit: standard input: no column is called N or n; say which by -x' \
    'printf "16 .1\n32 .06\n64 .03\n" | koksma-fit'
t fit-named 1 "" 'koksma-fit: standard input: no column is called "err"' \
    'printf "# N e\n1 1\n" | koksma-fit -y err'
t fit-zero 1 "" \
    'koksma-fit: standard input: no line names the columns: give a number from 1, not "0"' \
    'echo 1 1 | koksma-fit -x 0 -y 2'
t fit-short 1 "" \
    'koksma-fit: standard input: 1 usable N in [0, inf], and a fit takes 3; left out: 0 incomplete, 0 of zeros, 0 below rounding' \
    'printf "16 4\n" | koksma-fit -x 1 -y 2'
t fit-empty 1 "" 'koksma-fit: standard input: no rows in it' 'echo "# N error" | koksma-fit'
t fit-zeros 1 "" \
    'koksma-fit: standard input: errors of 0 at all 3 N in the window: there is nothing to fit' \
    'printf "16 0\n32 0\n64 0\n" | koksma-fit -x 1 -y 2'
has fit-floor 1 '0 usable N in .*, 3 below rounding' \
    'printf "# koksma: largest=1\n# N error\n16 4e-17\n32 2e-17\n64 1e-17\n" | koksma-fit'
t fit-negative 1 "" \
    'koksma-fit: standard input: row 2 has N = -32 and error 1: N must be above 0, both finite' \
    'printf "16 2\n-32 1\n64 1\n" | koksma-fit -x 1 -y 2'
t fit-no-interval 1 "" \
    'koksma-fit: one path has no interval: --level and --margin take replicates' \
    'printf "16 4\n64 1\n256 .25\n" | koksma-fit -x 1 -y 2 --level 0.9'
t fit-path 1 "" 'koksma-fit: --path 2: the table has 1 set' \
    'printf "16 4\n64 1\n256 .25\n" | koksma-fit -x 1 -y 2 --path 2'
t short-set 1 "" 'koksma-error: set 1 has 2 values, and --prefixes asks for 4' \
    'printf "0 0\n0 1\n" | koksma-error --exact 0 --prefixes 1,4'
t mean-of-one 1 "" \
    'koksma-error: --exact mean takes replicates: the error of one set from its own mean ends at 0' \
    'printf "0 0\n0 1\n" | koksma-error --exact mean'
t mean-of-short 1 "" \
    'koksma-error: --exact mean writes N up to 256 of sets of 1024' \
    'koksma-points random -n 1024 --replicates 2 | koksma-eval f2 |
     koksma-error --exact mean --prefixes 1024'
t fit-word 1 "" 'koksma-fit: line 2: column 2 is four, not a finite number' \
    'printf "16 4\n32 four\n" | koksma-fit -x 1 -y 2'

# ---- L2 discrepancies --------------------------------------------------------------

t l2 0 "# koksma: measure=l2
# n${tab}dim${tab}lower${tab}upper
1${tab}1${tab}0.08333333333333331${tab}0.08333333333333334" "" \
    'echo 0.5 | koksma-l2 -k centered -m divide --squared'
t l2-one-point 0 "1${tab}1${tab}0.5773502691896256${tab}0.577350269189626" "" \
    'echo 0 | koksma-l2 -q'
t l2-prefixes 0 "1${tab}1
2${tab}1
4${tab}1
5${tab}1" "" \
    'seq 0 0.25 1 | koksma-l2 -q --prefixes 1:4,5 | cut -f 1,2'
t l2-prefix-too-long 1 "" 'koksma-l2: set 1 has 1 point, and --prefixes asks for 2' \
    'echo 0 | koksma-l2 -q --prefixes 2'
has l2-log10 0 '^1	1000	-238.56' \
    'koksma-points grid -d 1000 -n 1 | sed "/^#/d;s/0/1/g" | koksma-l2 -q --log10'
has l2-small 0 'out of the range of doubles: see --log10' \
    'koksma-points grid -d 1000 -n 1 | sed "s/0.5/1/g" | koksma-l2 -k extreme'
has l2-verbose 0 'star, divide, .* steps' 'koksma-points halton -n 9 | koksma-l2 -v -m divide'
has l2-prefix-word 2 '^koksma-l2: --prefixes takes' 'echo 0 | koksma-l2 --prefixes 4:2'
has l2-kind 2 '^koksma-l2: -k takes star, .*, not "best"$' 'echo 0 | koksma-l2 -k best'
has l2-method 2 '^koksma-l2: -m takes .*, not "best"$' 'echo 0 | koksma-l2 -m best'
has l2-time 3 '0	inf$' 'koksma-points random -d 20 -n 30000 | koksma-l2 -q -t 0.01 -m pairs'

# ---- Bad command lines -------------------------------------------------------------

try="
Try 'koksma-points -h'."
t no-family 2 "" "koksma-points: name one family; --list lists them$try" 'koksma-points'
t family 2 "" "koksma-points: no family is called \"hilton\"; --list lists them$try" \
    'koksma-points hilton'
t list-family 2 "" "koksma-points: no family is called \"foo\"; --list lists them$try" \
    'koksma-points --list foo'
has list-two 2 'name one family' 'koksma-points --list halton sobol'
t bases-few 2 "" "koksma-points: 1 base, but halton in dimension 2 takes 2$try" \
    'koksma-points halton --bases 2'
t no-vector 2 "" "koksma-points: halton takes no vector$try" 'koksma-points halton --vector 1,2'
t number-tail 2 "" \
    "koksma-points: -n takes a whole number from 1 to 18446744073709551615, not \"10k\"$try" \
    'koksma-points halton -n 10k'
has number-zero-power 2 'not "0^18446744073709551615"$' \
    'koksma-points halton -n 0^18446744073709551615'
t number-one-power 0 "0${tab}0" "" 'koksma-points halton -q -n 1^18446744073709551615'
t no-grid 2 "" "koksma-points: 10 points make no grid in 2 dimensions: no m^2$try" \
    'koksma-points grid -n 10'
t equal-replicates 2 "" \
    "koksma-points: replicates of sobol would be equal: --scramble makes them differ$try" \
    'koksma-points sobol --replicates 2'
t common-factor 2 "" "koksma-points: bases 4 and 6 have a common factor$try" \
    'koksma-points halton --bases 4,6'
t sobol-dim 2 "" "koksma-points: dimension 1112: sobol has 1 to 1111$try" \
    'koksma-points sobol -d 1112'
t no-net 0 "0${tab}0" "koksma-points: 1000 points of sobol are no net: 512 or 1024 would be" \
    'koksma-points sobol -n 1000 -q | head -n 1'
t leap 0 "0${tab}0
0.78125${tab}0.4074074074074074" "" 'koksma-points halton -n 2 --leap 19 -q'
t leap-factor 2 "" "koksma-points: leap 6 and base 2 have a common factor$try" \
    'koksma-points halton --leap 6'
t leap-too-far 2 "" "koksma-points: indices reach beyond 2^64 - 1$try" \
    'koksma-points random --leap 2^63 -n 3'
t scramble-word 2 "" \
    "koksma-points: --scramble takes none, digits, owen, matrix or shift, not \"nested\"$try" \
    'koksma-points sobol --scramble nested'
t scramble-none 2 "" "koksma-points: grid has no digits to scramble$try" \
    'koksma-points grid -n 4 --scramble owen'
t faure 0 "0${tab}0${tab}0
0.3333333333333333${tab}0.3333333333333333${tab}0.3333333333333333
0.6666666666666666${tab}0.6666666666666666${tab}0.6666666666666666
0.1111111111111111${tab}0.4444444444444444${tab}0.7777777777777777" "" \
    'koksma-points faure -d 3 -n 3^7 -q | head -n 4'
t fibonacci 0 "0${tab}0
0.19999999999999998${tab}0.6" "" 'koksma-points fibonacci -n 5 -q | head -n 2'
t vector 0 "# koksma-points kronecker --vector 0.25,3.5 -n 3
# koksma: points=kronecker scramble=none
0${tab}0
0.25${tab}0.5
0.5${tab}0" "" 'koksma-points kronecker --vector 0.25,3.5 -n 3'
t vandercorput 0 "0
0.5
0.25" "" 'koksma-points vandercorput -n 4 -q | head -n 3'
t vector-missing 2 "" \
    "koksma-points: korobov in dimension 2 takes a vector of 1, not of 0$try" \
    'koksma-points korobov -n 7'
t vector-long 2 "" \
    "koksma-points: lattice in dimension 2 takes a vector of 2, not of 3$try" \
    'koksma-points lattice -n 7 --vector 1,2,3'
t vector-word 2 "" \
    "koksma-points: --vector takes a whole number from 0 to 18446744073709551615, not \"1.5\"$try" \
    'koksma-points lattice -n 7 --vector 1,1.5'
t no-fibonacci 2 "" "koksma-points: 100 points: 89 and 144 are Fibonacci numbers$try" \
    'koksma-points fibonacci -n 100'
t zaremba 0 "0${tab}0.25
0.25${tab}0.75
0.5${tab}0
0.75${tab}0.5" "" 'koksma-points zaremba -n 4 -q'
t disks-too-many 2 "" \
    "koksma-points: only 1 point found that are 1 apart, not 2$try" \
    'koksma-points poisson -n 2 --radius 1 --torus'
t radius 2 "" "koksma-points: halton keeps no radius$try" \
    'koksma-points halton --radius 0.1'
t latin 0 "0
1
2
3" "" 'koksma-points latin -d 1 -n 4 -q | awk "{ print int(\$1 * 4) }" | sort'
t too-far 2 "" "koksma-points: indices reach beyond 2^64 - 1$try" \
    'koksma-points halton --start 18446744073709551615 -n 2'
t prefixes-fall 2 "" \
    "koksma-error: --prefixes takes numbers that rise, not \"4,2\"
Try 'koksma-error -h'." 'koksma-error --prefixes 4,2'
has prefixes-range 2 'takes a whole number from 8 to' 'koksma-error --prefixes 8:4'
has method 2 '^koksma-star: -m takes .*, not "best"$' 'echo .5 | koksma-star -m best'
has unknown-option 2 "Try 'koksma-star -h'." 'koksma-star --nonsense'
has parameter 2 'f2 has a from 0 to 0.5, not 0.75' 'echo 0 0 | koksma-eval f2 -a .75'
t parameter-open 2 "" "koksma-eval: sphere has albedo between 0 and 1, both excluded, not 1$(echo "$try" | sed s/points/eval/)" \
    'koksma-eval sphere --albedo 1 </dev/null'
has cap 2 'sphere has cap between 0 and 1, both excluded, not 0' 'koksma-eval sphere --cap 0'
has no-parameter 2 'ball has no parameter q' 'koksma-eval ball -a q=1'
has none-at-all 2 'sum has no parameters' 'koksma-eval sum -a 1'
has no-bounces 2 'f2 has no bounces' 'koksma-eval f2 --bounces 2'
has beta 2 '^koksma-fit: --beta lies between 1 and 2 in dimension 2, not at 5$' \
    'koksma-fit -d 2 --beta 5'
has beta-said 2 '^koksma-fit: --beta lies between 2 and 3 in dimension 3, not at 1.9$' \
    'printf "# koksma: dim=3\n# N error\n16 4\n" | koksma-fit --beta 1.9'
has bounces-differ 2 '^koksma-eval: --bounces 1 of sphere is dimension 2, and -d says 6$' \
    'koksma-eval sphere --bounces 1 -d 6'
has integrand-dim 2 '3 coordinates a point, but f2 takes 2' 'koksma-eval f2 -d 3'

# ---- Faults of the system, and stopping ---------------------------------------------

if [ -w /dev/full ]; then
    t full-disk 1 "" \
        'koksma-points: standard output: cannot write: No space left on device' \
        'koksma-points halton -n 1e5 >/dev/full'
    t full-disk-small 1 "" \
        'koksma-star: standard output: cannot write: No space left on device' \
        'echo .5 | koksma-star >/dev/full'
    t full-disk-npy 1 "" \
        'koksma-points: standard output: cannot write: No space left on device' \
        'koksma-points halton -n 1e5 --npy >/dev/full'
fi
t closed-pipe 0 "# koksma-points halton -n 2^40" "" 'koksma-points halton -n 2^40 | head -n 1'
has time-limit 3 '^5000	12	0\.' 'koksma-points random -d 12 -n 5000 | koksma-star -t 0.05 -q'
has interrupt 3 '	1$' \
    'koksma-points random -d 12 -n 5000 >p
     sh -c "trap - INT; exec koksma-star -q p" & ./caught $!; kill -INT $!; wait $!'

has interrupt-twice 3 '	1$' \
    'sh -c "trap - INT; exec koksma-star -q p" & ./caught $!
     kill -INT $!; kill -INT $!; wait $!'

rows_end
