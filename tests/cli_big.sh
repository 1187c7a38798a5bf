#!/bin/sh
# Streams of gigabytes and lines of gigabytes, where there is time and memory for
# them: make check-big.  Rows as in cli.sh.
case ${CK_EXCLUDE_TAGS-big} in *big*) exit 77 ;; esac
. "${top_srcdir:=.}/tests/cli_rows.sh"

# ---- Streams, in memory that does not grow with them -------------------------------

# A tool within 60 MB, where it starts within that: under sanitizers it does not.
if sh -c 'ulimit -v 60000 && koksma-star -V; exit $?' >/dev/null 2>&1; then
    printf '#!/bin/sh\nulimit -v 60000\nexec "$@"\n' >small
    chmod +x small

    # 2^25 points, 0.5 GB as an array and 1.9 GB as text.
    t stream 0 "33554432" "" \
        './small koksma-points halton -n 2^25 --npy | ./small koksma-eval f2 |
         ./small koksma-error --prefixes 2^25 -q | cut -f 2'
    t stream-of-text 0 "16777216" "" \
        './small koksma-points sobol -n 2^24 | ./small koksma-eval f2 --hex |
         ./small koksma-error --prefixes 2^24 -q | cut -f 2'
    t stream-of-sets 0 "1000000" "" \
        './small koksma-points random -n 16 --replicates 1e6 | ./small koksma-eval f2 |
         ./small koksma-error --prefixes 16 -q | wc -l | tr -d " "'
    t stream-of-measures 0 "200000" "" \
        './small koksma-points random -n 64 --replicates 2e5 | ./small koksma-l2 -q |
         wc -l | tr -d " "'
    t stream-of-comments 0 "1${tab}1${tab}0.5${tab}0.5" "" \
        '{ yes "# koksma: points=none and more words of no interest" | head -c 1500M
           echo; echo 0.5; } | ./small koksma-star -q'
    t stream-of-blanks 0 "1${tab}1${tab}0.5${tab}0.5" "" \
        '{ yes "   " | head -c 1500M; echo; echo 0.5; } | ./small koksma-star -q'
    # A grid of values, 2^27 of them: it keeps three layers of 2^14.
    t stream-of-values 0 "2${tab}converged" "" \
        '{ printf "\223NUMPY\001\0\166\0"
           printf "%-117s\n" "{'"'descr': '<f8', 'fortran_order': False, 'shape': (8192, 16384), }"'"
           head -c 1073741824 /dev/zero; } | ./small koksma-variation -q |
         cut -f 1,7'
else
    echo "left out: the tools do not start in 60 MB"
fi

# ---- Lines of 2.2 GB ---------------------------------------------------------------

# long CHARACTER: so many of it, without an end.
printf '#!/bin/sh\nhead -c 2200M /dev/zero | tr "\\0" "$1"\n' >long
chmod +x long

free=$(awk '/^MemAvailable/ { print int($2 / 1e6) }' /proc/meminfo 2>/dev/null)
if [ "${free:-0}" -ge 5 ]; then
    t long-blank 0 "1${tab}1${tab}0.5${tab}0.5" "" '{ ./long " "; echo .5; } | koksma-star -q'
    t long-comment 0 "1${tab}1${tab}0.5${tab}0.5" "" \
        '{ ./long "#"; echo; echo .5; } | koksma-star -q'
    t long-number 0 "1${tab}1${tab}0.6666666666666666${tab}0.6666666666666667" "" \
        '{ printf 0.; ./long 3; echo; } | koksma-star -q'
    t long-word 1 "" \
        "koksma-star: line 1: column 1 is $(printf '%040d' 0 | tr 0 x)..., not a number" \
        './long x | koksma-star -q'
    t long-nul 1 "" 'koksma-star: line 1: a NUL byte: this is not text' \
        './long "\0" | koksma-star -q'
    t long-field 0 "power${tab}-1" "" \
        '{ echo "# N error"; printf "16 4 "; ./long x; printf "\n64 1\n256 .25\n"; } |
         koksma-fit -q | cut -f 1,2'
else
    echo "left out: the lines of gigabytes take 5 GB"
fi

rows_end
