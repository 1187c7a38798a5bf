#!/bin/sh
# The comparison with other programs: what it says of those that are absent, right,
# wrong, slow (124, as timeout says) or broken.  Here they are all made up.
: "${top_srcdir:=.}" "${top_builddir:=.}"
peers=$(cd "$top_srcdir/tests" && pwd)/peers.sh
BENCH_RUN=$(cd "$top_builddir/tests" && pwd)/bench_run
. "$top_srcdir/tests/cli_rows.sh"

unset BENCH_GEN PEER_SECONDS
PYTHON=false PEER_TA=missing PEER_DEM=echo
PEER_SETS='fibonacci -n 8; random -n 3'
PEERS='right=echo 2 seeds, 0.234375 found; half=echo 0.1171875; twice=echo +4.6875E-1
  ; words=echo %d%n; lines=wc -l <%f; stdin=wc -l; bad=exit 3; mute=echo nothing;
  slow=exit 124; mine/l2=echo 1'
export BENCH_RUN PYTHON PEER_DEM PEER_TA PEER_SETS PEERS
sh "$peers" >table 2>&1

# of NAME VALUE ERROR: what a program is said to have found.
of() {
    t "$1" 0 "$2${tab}-${tab}$3" "" "grep '^fib.*star$tab$1$tab' table | cut -f 4-6"
}
says() { # NAME WHAT
    t "$1" 0 "# fibonacci -n 8, star: $1: $2" "" "grep '^# fib.*: $1:' table"
}

t header 0 "# scipy: not installed, skipped
# openturns: not installed, skipped
# points${tab}measure${tab}program${tab}value${tab}upper${tab}error${tab}seconds${tab}MiB
fibonacci -n 8${tab}star${tab}koksma${tab}0.234375${tab}0.234375${tab}0" "" \
    'head -n 4 table | cut -f 1-9 | sed "4s/\(.*\)\t.*\t.*/\1/"'
of right 0.234375 0
of half 0.1171875 -0.5
of twice +4.6875E-1 1
of words 28 118
of lines 8 33.1
of stdin 8 33.1
of dem 8 33.1
says ta 'failed with exit status 127'
says bad 'failed with exit status 3'
says mute 'printed no number'
says slow 'not within 60 seconds'
t other-measure 0 "l2" "" "grep '^fib.*mine' table | cut -f 2"
t two-sets 0 "random -n 3${tab}mixture-squared${tab}koksma" "" "tail -n 1 table | cut -f 1-3"

rows_end
