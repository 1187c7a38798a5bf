#!/bin/sh
# koksma-plot as its users meet it.  What it tells gnuplot is looked at through a
# gnuplot that repeats it; the real one, where there is one, draws at the end.
. "${top_srcdir:=.}/tests/cli_rows.sh"

real_path=$PATH
mkdir echoing
printf '#!/bin/sh\ncat\n' >echoing/gnuplot
chmod +x echoing/gnuplot
PATH=$scratch/echoing:$PATH
export PATH

data='sed -n "/^\$table1/,/^KOKSMA_END/{/^[\$K]/!p;}"'
cat >summary <<END
# koksma: integrand=f2
# N${tab}rms${tab}lower${tab}upper${tab}sets${tab}mc
1${tab}0.5${tab}nan${tab}nan${tab}4${tab}.5
4${tab}0.125${tab}.1${tab}.2${tab}4${tab}.25
16${tab}0${tab}0${tab}0${tab}4${tab}.125
END
printf '# set\tN\terror\ttail\tmc\n1\t1\t-.5\t.5\t1\n1\t2\t.25\t.25\t.7\n2\t1\t.125\t1\t1\n' >errors
head='# model\texponent\tlower\tupper\tclaim\tverdict\tdoubt\tconstant\tsmooth\tfrom\tto\n'
printf "$head"'power\t-.5\t-.6\t-.4\t-.75\tdifferent\t-\t2\tnan\t1\t16\n' >fit

# ---- What is drawn -------------------------------------------------------------------

t summary 0 "1 0.5 NaN NaN .5
4 0.125 .1 .2 .25
16 NaN NaN NaN .125" "" "koksma-plot summary | $data"
t errors 0 "1 .5 NaN NaN 1
2 .25 NaN NaN .7

1 .125 NaN NaN 1" "" "koksma-plot -y error errors | $data"
t tail 0 "1 .5 NaN NaN 1
2 .25 NaN NaN .7

1 1 NaN NaN 1" "" "koksma-plot <errors | $data"
t one-n-a-set 0 "8 .5 NaN NaN NaN

8 .25 NaN NaN NaN" "" "printf '# set N error\n1 8 .5\n2 8 -.25\n' | koksma-plot | $data"
t by-number 0 "-.5 1 NaN NaN NaN
.25 1 NaN NaN NaN
.125 2 NaN NaN NaN" "" "koksma-plot -x3 --column-y=1 errors | $data"
t points 0 "0 .5 NaN NaN NaN
1 .25 NaN NaN NaN

.5 .5 NaN NaN NaN" "" "printf '0,.5\r\n# input\n1 .25 # last\n\n\n.5 .5\n' | koksma-plot | $data"
t values 0 "0.5 0.75 NaN NaN 0.8125" "" "echo .5 .75 | koksma-eval f2 -a .25 | koksma-plot | $data"
t trace 0 "0.001 1 .25 1 NaN
0.5 .5 .5 .5 NaN" "" \
    "printf '# seconds\tsteps\tlower\tupper\n0.000\t0\t.25\t1\n0.5\t9\t.5\t.5\n' | koksma-plot | $data"
t discrepancies 0 "1 0.75 0.75 0.75 NaN
2 0.625 0.625 0.625 NaN" "" \
    "printf '.5 .5\n0 .75\n' | koksma-star --prefixes 1,2 | koksma-plot | $data"
t fit 0 "1 2
16 0.5" "" 'koksma-plot summary fit | sed -n "/^.fit1/,/^KOKSMA_END/{/^[0-9]/p;}" | sed -n "1p;\$p"'
t fit-in-words 0 "summary: slope -0.500 [-0.600, -0.400], different from -0.75" "" \
    'koksma-plot summary fit | tr "\047" "\n" | grep "^summary"'
t two-terms 0 "2 5.91607978" "" \
    'printf "# model exponent lower upper constant smooth from to\ntwo-powers -.5 nan nan 4 10.392304845413264 1 2\n" |
     koksma-plot | grep "^2 "'
has axes 0 'set logscale x' 'koksma-plot summary'
has axes-told 0 'set logscale y' 'koksma-plot --log y -x3 -y1 errors'
t axes-none 0 "" "" 'koksma-plot --log none summary | grep logscale; :'
has title 0 "set title 'it''s' noenhanced" "koksma-plot --title \"it's\" summary"
has title-with-sign 0 "set title 'a=b'" 'koksma-plot --title=a=b summary'
has size-of-png 0 'pngcairo' 'koksma-plot -o p.png summary; cat p.png'

# ---- Names, and where it goes -----------------------------------------------------------

t odd-names 0 "title 'a b=1''s: slope" "" \
    "cp summary \"a b=1's\"; koksma-plot \"a b=1's\" fit | grep -o 'title .a b=1..s: slope'"
t order 0 "" "" 'koksma-plot summary -o 1.svg fit; koksma-plot -o2.svg -- summary fit
     koksma-plot --output=3.svg summary - <fit; cmp 1.svg 2.svg; cmp 1.svg 3.svg'
t nothing-left 0 "a.svg
t" "" 'mkdir d; cp summary d/t; cd d; TMPDIR=$PWD koksma-plot -o a.svg t; ls'
t input-names 0 "b c:1" "" \
    'printf "# input\tN\trms\nb c:1\t1\t.5\nb c:1\t2\t.25\n" | koksma-plot | tr "\047" "\n" | grep "^b c"'

# ---- What makes no sense ----------------------------------------------------------------

t empty 1 "" "koksma-plot: standard input: no rows to draw" ': | koksma-plot -o no.svg'
t none-drawn 0 "" "" '[ ! -e no.svg ]'
t no-column 1 "" 'koksma-plot: errors: no column is called "foo"' 'koksma-plot -x foo errors'
t no-names 1 "" 'koksma-plot: standard input: no line names the columns: give a number from 1, not "foo"' \
    'echo 1 2 | koksma-plot -y foo'
t column-zero 1 "" 'koksma-plot: standard input: no line names the columns: give a number from 1, not "0"' \
    'echo 1 2 | koksma-plot -x 0'
t far-column 1 "" 'koksma-plot: errors:2: 5 columns, but column 9 is wanted' 'koksma-plot -y 9 errors'
t one-column 1 "" 'koksma-plot: standard input:1: 1 column, but column 2 is wanted' \
    'echo 1 | koksma-plot -x 1 -y 2'
t which 1 "" "koksma-plot: standard input: it is not clear which columns to draw; say so by -x and -y" \
    'printf "# a b\n1 2\n" | koksma-plot'
t word 1 "" 'koksma-plot: standard input:2: column 2 is "0x1p-1", not a decimal number' \
    'printf "0 1\n0 0x1p-1\n" | koksma-plot'
t npy 1 "" "koksma-plot: p.npy: an .npy file, and koksma-plot reads text" \
    'koksma-points halton --npy >p.npy; koksma-plot p.npy'
t zeros 1 "" "koksma-plot: there is nothing that these axes could show" \
    'printf "# N error\n1 0\n" | koksma-plot'
t kinds 1 "" "koksma-plot: -: a table of another kind than the one before it" \
    'echo 1 2 | koksma-plot summary - 2>&1 | sed "s/standard input/-/" >&2; exit 1'
t no-file 1 "" "koksma-plot: nosuch: No such file or directory" 'koksma-plot nosuch'
t folder 1 "" "koksma-plot: .: Is a directory" 'koksma-plot .'
t no-folder 1 "" "koksma-plot: no/such.svg: cannot write" 'koksma-plot -o no/such.svg summary'
t suffix 2 "" "koksma-plot: --output takes a FILE.svg or FILE.png, not \"a.gif\"
Try 'koksma-plot -h'." 'koksma-plot -o a.gif summary'
t no-argument 2 "" "koksma-plot: option '-x' requires an argument
Try 'koksma-plot -h'." 'koksma-plot summary -x'
t no-option 2 "" "koksma-plot: unrecognized option '--colour'
Try 'koksma-plot -h'." 'koksma-plot --colour summary'
t bad-log 2 "" "koksma-plot: --log takes x, y, xy or none, not \"z\"
Try 'koksma-plot -h'." 'koksma-plot --log z summary'
t no-gnuplot 1 "" "koksma-plot: gnuplot, which draws the pictures, is not installed" \
    "plot=\$(command -v koksma-plot); PATH=\$PWD/nowhere; \"\$plot\" summary"
printf '#!/bin/sh\necho half; echo "line 0: trouble" >&2; exit 1\n' >echoing/gnuplot
t failing 1 "" "koksma-plot: gnuplot failed: line 0: trouble" 'koksma-plot -o half.svg summary'
t failing-leaves-nothing 0 "" "" '[ ! -e half.svg ]'
printf '#!/bin/sh\nyes\n' >echoing/gnuplot
t closed-pipe 0 "y" "" 'koksma-plot summary | head -n 1'
printf '#!/bin/sh\ncat\n' >echoing/gnuplot
t closed-out 1 "" "koksma-plot: standard output: cannot write" 'koksma-plot summary >&-'
t closed-in 1 "" "koksma-plot: standard input: cannot read" 'koksma-plot <&-'
t folder-in 1 "" "koksma-plot: standard input: Is a directory" 'koksma-plot <.'
t closed-in-unread 0 "" "" 'koksma-plot summary <&- >/dev/null'
if [ -w /dev/full ]; then
    t full-disk 1 "" "koksma-plot: standard output: cannot write" 'koksma-plot summary >/dev/full'
fi

# ---- The real gnuplot ----------------------------------------------------------------------

PATH=$real_path
if command -v gnuplot >/dev/null 2>&1; then
    has text 0 'largest error after N samples\|N  *$' 'koksma-plot errors'
    t svg 0 "" "" 'koksma-plot -o s.svg summary fit && grep -q "different from -0.75" s.svg && grep -q "</svg>" s.svg'
    t png 0 "PNG" "" 'koksma-plot -o s.png summary fit && head -c 4 s.png | tail -c 3; echo'
    t one-point 0 "" "" 'echo .5 .5 | koksma-plot -o one.svg; grep -q "</svg>" one.svg'
    t many-sets 0 "" "" 'koksma-points random -n 20 --replicates 12 | koksma-eval f2 | koksma-error | koksma-plot -o m.svg
         grep -q "standard input, 12 sets" m.svg'
else
    echo "There is no gnuplot: what it makes of the scripts was not looked at."
fi

rows_end
