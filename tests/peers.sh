#!/bin/sh
# peers.sh: other programs beside ours, on the same points.  A row each; in the column
# error, by how much a value misses our certified interval, as a share of it: 0
# inside, negative if it is too small.  Seconds are CPU seconds of one thread: of
# SciPy and OpenTURNS those of the call alone, of all others those of the whole
# command, with its start and its reading.  MiB is the peak of the whole process.
# What is not installed is skipped in one line.
#
# In the environment:
#   PEER_SETS      words for koksma-points, sets apart by ";"
#   PEERS          programs that print the star discrepancy as their last number:
#                  "NAME=COMMAND", apart by ";"; in COMMAND %d, %n and %f stand for
#                  dim, n and the file, which is also standard input.  NAME may end
#                  with "/" and another measure of the table
#   PEER_DEM, PEER_TA  short for "dem=PROGRAM %d %n %f" and "ta=..."
#   PEER_SECONDS   each run is cut after so many (60)
#   PYTHON         the Python that has SciPy or OpenTURNS (python3, or the system's)
#   BENCH_GEN      bench_gen, which is then run too: generators, those of GSL and SciPy
#                  beside ours
# Finds the tools by PATH.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
: "${BENCH_RUN:=$PWD/tests/bench_run}" "${PEER_SECONDS:=60}"
: "${PEER_SETS=halton -d 2 -n 1000 --start 1; halton -d 2 -n 10000 --start 1;
  halton -d 3 -n 1000 --start 1; sobol -d 8 -n 256; random -d 20 -n 200; centred -d 1 -n 10000;
  centred -d 1 -n 100000}"
programs="${PEERS-};${PEER_DEM+dem=$PEER_DEM %d %n %f};${PEER_TA+ta=$PEER_TA %d %n %f}"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# cost COMMAND...: its output into ./out, its CPU $seconds and $mib.
cost() {
    "$BENCH_RUN" cost timeout "$PEER_SECONDS" "$@" >out 2>err <points && status=0 || status=$?
    read -r seconds _ mib <cost
}

# row PROGRAM VALUE UPPER: behind what all rows of a set have.
row() {
    awk -v set="$set" -v measure="$measure" -v program="$1" -v value="$2" -v above="$3" \
        -v lower="$lower" -v upper="$upper" -v seconds="$seconds" -v mib="$mib" 'BEGIN {
        error = value < lower ? (value - lower) / lower : value > upper ? (value - upper) / upper : 0
        OFS = "\t"
        print set, measure, program, value, above, sprintf("%.3g", error), seconds, mib
    }'
}

failed() { # PROGRAM
    case $status in
    77) return ;; # said at the beginning
    124) why="not within $PEER_SECONDS seconds" ;;
    no-number) why='printed no number' ;;
    *) why="failed with exit status $status" ;;
    esac
    echo "# $set, $measure: $1: $why"
}

# own COMMAND: the measure's own row, and the interval of all that follow.
own() {
    lower='' upper=''
    # shellcheck disable=SC2086 # several words
    cost $1 -q -j 1 points
    [ "$status" -eq 0 ] && read -r n dim lower upper <out || {
        failed koksma
        return 1
    }
    row koksma "$lower" "$upper"
}

python_peer() { # PROGRAM METHOD
    case " $packages " in *" $1 "*) ;; *) return 0 ;; esac
    cost "$python" "$here/peers.py" "$1" "$2" points
    [ $status -eq 0 ] && read -r value seconds <out || {
        failed "$1 $2"
        return 0
    }
    row "$1 $2" "$value" -
}

last_number='{
    for (i = 1; i <= NF; i++)
        if ($i ~ /^[-+]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][-+]?[0-9]+)?$/) last = $i
} END { print last }'

# named_peers: the programs of the environment that compute the measure.
named_peers() {
    echo "$programs" | tr ';' '\n' | while IFS='=' read -r name command; do
        name=$(echo "$name" | tr -d ' ')
        case $name in
        '') continue ;;
        */*) [ "${name#*/}" = "$measure" ] || continue ;;
        *) [ "$measure" = star ] || continue ;;
        esac
        cost sh -c "$(echo "$command" | sed "s/%d/$dim/g; s/%n/$n/g; s/%f/points/g")"
        value=$(awk "$last_number" out)
        [ "$status" -ne 0 ] || [ -n "$value" ] || status=no-number
        [ "$status" = 0 ] && row "${name%/*}" "$value" - || failed "${name%/*}"
    done
}

# The Python packages that are there; the system's python3 has those of its packages.
find_packages() {
    packages='' python=none
    for python in ${PYTHON-python3 /usr/bin/python3}; do
        for package in scipy openturns; do
            case " $packages " in *" $package "*) continue ;; esac
            "$python" -c "import $package" 2>/dev/null && packages="$packages $package" || :
        done
        [ -z "$packages" ] || break
    done
    for package in scipy openturns; do
        case " $packages " in
        *" $package "*) ;;
        *) echo "# $package: not installed, skipped" ;;
        esac
    done
}

# What is compared: the measure, our tool, and who else has it.
table='star|koksma-star|openturns star
l2|koksma-l2|scipy L2-star
centered|koksma-l2 -k centered|openturns C2
centered-squared|koksma-l2 -k centered --squared|scipy CD
wraparound-squared|koksma-l2 -k wraparound --squared|scipy WD
mixture-squared|koksma-l2 -k mixture --squared|scipy MD'

find_packages
printf '# points\tmeasure\tprogram\tvalue\tupper\terror\tseconds\tMiB\n'
printf '%s;' "$PEER_SETS" | tr '\n' ' ' | tr ';' '\n' | while read -r set; do
    # shellcheck disable=SC2086 # several words
    koksma-points $set -q >points
    echo "$table" | while IFS='|' read -r measure tool peer; do
        own "$tool" || continue
        # shellcheck disable=SC2086 # a program and a method
        python_peer $peer
        named_peers
    done
done
[ -z "${BENCH_GEN-}" ] || PYTHON=$python "$BENCH_GEN"
