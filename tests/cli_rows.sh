# What the scripts of rows share; they source it and end with rows_end.  A row is
# a command, and what it must print on both outputs and return.
set -u
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch" || exit 1
tab=$(printf '\t')
failures=0

# ./caught PID: wait until that process catches interrupts, for ten seconds at most;
# where the system does not say so, a while.
cat >caught <<'END'
#!/bin/sh
for _ in $(seq 1000); do
    case $(sed -n 's/^SigCgt:.*\(.\)$/\1/p' "/proc/$1/status" 2>/dev/null) in
    [2367abefABEF]) exit ;;
    '') exec sleep 0.3 ;;
    esac
    sleep 0.01
done
END
chmod +x caught

# t NAME STATUS STDOUT STDERR COMMAND: run COMMAND and compare all three.
t() {
    sh -c "$5" >out 2>err </dev/null
    status=$?
    printf '%s' "${3:+$3
}" >want.out
    printf '%s' "${4:+$4
}" >want.err
    [ "$status" -eq "$2" ] && cmp -s out want.out && cmp -s err want.err && return
    failures=$((failures + 1))
    echo "FAILED: $1: $5"
    [ "$status" -eq "$2" ] || echo "exit status $status, not $2"
    diff want.out out
    diff want.err err
}

# has NAME STATUS PATTERN COMMAND: only the status, and a line of either output.
has() {
    sh -c "$4" >out 2>&1 </dev/null
    status=$?
    [ "$status" -eq "$2" ] && grep -q -e "$3" out && return
    failures=$((failures + 1))
    echo "FAILED: $1: $4"
    echo "exit status $status (want $2), and no line like '$3' in:"
    head -n 20 out
}

rows_end() {
    [ "$failures" -eq 0 ] || echo "$failures rows failed"
    [ "$failures" -eq 0 ]
}
