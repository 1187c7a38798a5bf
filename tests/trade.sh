#!/bin/sh
# trade.sh FOLDER [KNOB]...: what the knobs of the tools cost and buy, a table each,
# FOLDER/trade_KNOB.tsv; all of them if none is named.  trade_plot.sh draws them.
#
# Seconds are CPU seconds of one thread, of the whole command that the last column
# repeats, with the start of its processes (1 to 2 ms each) and the reading of its
# input.  Finds the tools by PATH, and bench_run beside the build's tests, or as
# BENCH_RUN says.
# shellcheck disable=SC2154 # "read" sets seconds, lower and the like
set -eu
: "${BENCH_RUN:=$PWD/tests/bench_run}"
mkdir -p "$1"
tables=$(cd "$1" && pwd)
shift
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# cost COMMAND: its output into ./out, and its CPU $seconds.  3: stopped, as it was
# told to.
cost() {
    command=$1
    "$BENCH_RUN" cost sh -c "$command" >out 2>err || [ $? -eq 3 ] || {
        cat err >&2
        exit 1
    }
    read -r seconds rest <cost
}

# column NAME: that of the last row of ./out.
column() {
    awk -F '\t' -v name="$1" '
    /^# / { sub(/^# /, ""); for (i = 1; i <= NF; i++) at[$i] = i; next }
    { value = $at[name] }
    END { print value }' out
}

# row FIELD...: separated by tabs, and the command.
row() {
    printf '%s\t' "$@"
    printf '%s\n' "$command"
}

header() { printf '# %s\tcommand\n' "$(echo "$*" | tr ' ' '\t')"; }

# relative LOWER UPPER: the width of the interval as a share of its lower end.
relative() { awk -v l="$1" -v u="$2" 'BEGIN { printf "%.3g", (u - l) / l }'; }

# ---- The star discrepancy -------------------------------------------------------------

# star FIELD COMMAND: a row for one run.
star() {
    cost "$2"
    lower=$(column lower) upper=$(column upper)
    row "$points" "$1" "$seconds" "$lower" "$upper" "$(relative "$lower" "$upper")"
}

star_tolerance() {
    header points tolerance seconds lower upper width
    for points in 'halton -d 3 -n 10000' 'sobol -d 10 -n 512' 'random -d 20 -n 200'; do
        for e in 4 2 1 0.5 0.25 0.1 0.05 0.02 0; do
            star $e "koksma-points $points | koksma-star -j 1 -e $e"
        done
    done
}

star_time() {
    header points asked seconds lower upper width
    for points in 'halton -d 3 -n 20000' 'sobol -d 10 -n 512' 'sobol -d 12 -n 1024'; do
        for t in 0.1 0.2 0.5 1 2 5; do
            star $t "koksma-points $points | koksma-star -j 1 -t $t"
        done
    done
}

# What the search has found when.  The trace tells the time by the clock; here it is
# CPU time, in proportion to the points looked at.
star_search() {
    header points seed seconds looked_at lower
    for points in 'sobol -d 10 -n 512' 'sobol -d 20 -n 1024'; do
        for s in 1 2 3 4 5; do
            cost "koksma-points $points | koksma-star -m search -s $s --trace -v"
            all=$(sed -n 's/.*, \([^ ]*\) points looked at.*/\1/p' err)
            grep -v '^#' out | while read -r _ looked_at lower _; do
                row "$points" $s "$(awk -v s="$seconds" -v l="$looked_at" -v a="$all" \
                    'BEGIN { printf "%.4g", s * l / a }')" "$looked_at" "$lower"
            done
            row "$points" $s "$seconds" "$all" "$(column lower)"
        done
    done
}

# ---- Other measures -------------------------------------------------------------------

l2_method() {
    header method dim n seconds lower upper width
    for dim in 2 3 6; do
        for method in pairs divide; do
            for log2n in 8 9 10 11 12 13 14 15 16 17 18 19 20; do
                case $method-$dim-$log2n in
                pairs-*-1[6-9] | pairs-*-20 | divide-6-1[6-9] | divide-6-20) continue ;;
                esac
                koksma-points halton -d $dim -n 2^$log2n --start 1 --npy >points
                cost "koksma-l2 -j 1 -m $method points"
                command="koksma-points halton -d $dim -n 2^$log2n --start 1 --npy | $command"
                lower=$(column lower) upper=$(column upper)
                row $method $dim "$(column n)" "$seconds" "$lower" "$upper" \
                    "$(relative "$lower" "$upper")"
            done
        done
    done
}

# The ball's cells: K, its interval, and the extent that the lines find.
cells_lines() {
    header method dim lines N seconds K K_lower K_upper extent_lower extent_upper width
    for dim in 2 3 4; do
        for lines in 30 100 300 1000 3000 10000 30000; do
            cells lines $lines "-m lines --lines $lines"
        done
        case $dim in 2) more='24 36 40' ;; 3) more='24 30 32' ;; *) more='20 24 26' ;; esac
        for log2n in 12 $more; do
            cells exact 0 "" "2^$log2n"
        done
    done
}

cells() { # METHOD LINES OPTIONS [N]
    cost "koksma-cells ball -d $dim -n ${4:-2^24} $3"
    lower=$(column K_lower) upper=$(column K_upper)
    row "$1" "$dim" "$2" "$(column n)" "$seconds" "$(column K)" "$lower" "$upper" \
        "$(column extent_lower)" "$(column extent_upper)" "$(relative "$lower" "$upper")"
}

# known: the variation of the integrand; short: what share of it the grid's lacks.
variation_cells() {
    header method dim k samples seconds variation lower upper known short width
    for dim in 1 2 3 4; do
        case $dim in 1) most=18 ;; 2) most=11 ;; 3) most=7 ;; *) most=5 ;; esac
        for log2k in $(seq 1 $most); do
            variation grid "--cells $((1 << log2k))" 0
        done
    done
    dim=6
    for log2s in 16 18 20 22 24; do
        variation random "--cells 16 --samples 2^$log2s" $((1 << log2s))
    done
}

variation() { # METHOD OPTIONS SAMPLES
    known=$(koksma-eval --list gaussian -d "$dim" -q | cut -f 14)
    cost "koksma-variation gaussian -d $dim -m $1 $2"
    lower=$(column lower) upper=$(column upper) value=$(column variation)
    row "$1" "$dim" "$(column k)" "$3" "$seconds" "$value" "$lower" "$upper" "$known" \
        "$(awk -v v="$value" -v k="$known" 'BEGIN { printf "%.3g", 1 - v / k }')" "$(relative "$lower" "$upper")"
}

# ---- Errors, and files ----------------------------------------------------------------

fit_replicates() {
    header replicates seed seconds exponent lower upper width
    for replicates in 4 8 16 32 64 128 256; do
        for s in 1 2 3 4 5; do
            cost "koksma-points halton -d 2 -n 2^14 --scramble digits -s $s \
--replicates $replicates --npy | koksma-eval f2 -a 0 --npy | koksma-error --exact 0.5 -d 2 |
koksma-fit"
            command=$(echo "$command" | tr '\n' ' ')
            lower=$(column lower) upper=$(column upper)
            row $replicates $s "$seconds" "$(column exponent)" "$lower" "$upper" \
                "$(awk -v l="$lower" -v u="$upper" 'BEGIN { printf "%.3g", u - l }')"
        done
    done
}

# Made and written, and read again by koksma-error, which does the least with what it
# reads; mean: of the last coordinates, that of one form is that of the others.
text_npy() {
    header form n write read bytes mean
    for n in 1000 10000 100000 1000000; do
        for form in text hex npy; do
            option=--$form
            [ $form != text ] || option=
            cost "koksma-points random -d 2 -n $n $option >points"
            write=$seconds
            made=$command
            cost "koksma-error --exact 0 --prefixes $n points"
            command="$made; $command"
            row $form $n "$write" "$seconds" "$(wc -c <points)" "$(column error)"
        done
    done
}

[ $# -gt 0 ] || set -- star_tolerance star_time star_search l2_method cells_lines \
    variation_cells fit_replicates text_npy
for knob; do
    "$knob" >table
    mv table "$tables/trade_$knob.tsv"
    echo "$tables/trade_$knob.tsv"
done
