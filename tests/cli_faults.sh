#!/bin/sh
# The tools when the system fails them: outputs that take nothing, inputs that give
# nothing, too little memory, signals.  Rows as in cli.sh.
. "${top_srcdir:=.}/tests/cli_rows.sh"

koksma-points random -d 2 -n 9 >few
koksma-eval f2 few >values
printf '# N error\n16 4\n32 2\n64 1\n128 .5\n' >table

# ---- Outputs: a sentence or the system's signal, never silence ------------------

# A pipe that nobody reads any more.
mkfifo pipe
exec 3<>pipe 4>pipe
exec 3<&-

while read -r name command; do
    out="koksma-$name: standard output: cannot write:"
    t "closed-$name" 1 "" "$out Bad file descriptor" "$command >&-"
    t "pipe-$name" 141 "" "" "$command >&4"
    t "pipe-ignored-$name" 1 "" "$out Broken pipe" "trap '' PIPE; $command >&4"
    [ -w /dev/full ] &&
        t "full-$name" 1 "" "$out No space left on device" "$command >/dev/full"
done <<END
points koksma-points halton -n 9
star koksma-star few
l2 koksma-l2 few
box koksma-box few
edge koksma-edge few
eval koksma-eval f2 few
error koksma-error values
fit koksma-fit table
variation koksma-variation f2 --cells 4
cells koksma-cells ball
bound koksma-bound f2
END

# More than a buffer holds, so that it is full in the middle; and so much that the last
# byte alone finds it full, and the flush at the end nothing to write.
koksma-points random -n 4 --replicates 100 >many
koksma-eval f2 many >values
if [ -w /dev/full ]; then
    while read -r name command; do
        t "full-in-the-middle-$name" 1 "" \
            "koksma-$name: standard output: cannot write: No space left on device" \
            "$command >/dev/full"
    done <<END
points koksma-points halton -n 2^12
points koksma-points halton -n 2^12 --npy
points koksma-points halton -n 2^12 --hex
star koksma-star many
eval koksma-eval f2 many
error koksma-error values
cells koksma-cells --occupancy many
END
    koksma-points grid -n 1 >f
    size=$(koksma-star -q f f | wc -c) row=$((size / 2)) files=f
    more=$((4096 + 1 - size))
    while [ "$more" -ge "$row" ]; do
        files="$files f" more=$((more - row))
    done
    last=$(printf 'f%0*d' "$more" 0)
    [ "$more" -gt 0 ] || last=f
    cp f last.copy && mv last.copy "$last"
    t full-at-the-end 0 4097 "" "koksma-star -q $files $last | wc -c | tr -d ' '"
    has full-at-the-end-said 1 'standard output: cannot write\(: No space left on device\)*$' \
        "koksma-star -q $files $last >/dev/full"
fi

# A limit on the size of files is a signal, or where that is ignored a full disk.
if (ulimit -f 8) 2>/dev/null; then
    has file-limit 153 '' 'ulimit -f 8; koksma-points halton -n 1e4 >file; exit $?'
    t file-limit-ignored 1 "" \
        'koksma-points: standard output: cannot write: File too large' \
        'trap "" XFSZ; ulimit -f 8; koksma-points halton -n 1e4 >file'
fi

# ---- Inputs ---------------------------------------------------------------------

: >unreadable
chmod 000 unreadable
koksma-points halton -n 9 --npy | head -c 200 >cut.npy
koksma-points halton -n 9 --npy | head -c 100 >cut-header.npy
printf '0.5 0.25 1\n0.5 1e' >cut.txt
printf '0.5 0.25 1\n0.5 0x1.8p' >cut-hex.txt
mkdir folder

while read -r name command; do
    t "closed-in-$name" 1 "" \
        "koksma-$name: standard input: cannot read: Bad file descriptor" "$command <&-"
    t "folder-$name" 1 "" "koksma-$name: folder: Is a directory" "$command folder"
    t "folder-in-$name" 1 "" "koksma-$name: standard input: Is a directory" "$command <folder"
    t "no-file-$name" 1 "" "koksma-$name: none: No such file or directory" "$command none"
    [ -e /proc/self/mem ] &&
        has "broken-$name" 1 "^koksma-$name: /proc/self/mem: cannot read: I" \
            "$command /proc/self/mem"
    [ -r unreadable ] ||
        t "unreadable-$name" 1 "" "koksma-$name: unreadable: Permission denied" "$command unreadable"
    has "cut-$name" 1 "koksma-$name: cut.txt:2: .*1e, not a " "$command cut.txt"
    has "cut-hex-$name" 1 "koksma-$name: cut-hex.txt:2: .*0x1.8p, not a " "$command cut-hex.txt"
    [ "$name" = fit ] && continue
    t "cut-npy-$name" 1 "" "koksma-$name: cut.npy: the .npy array is cut short" "$command cut.npy"
    t "cut-header-$name" 1 "" "koksma-$name: cut-header.npy: the .npy array is cut short" \
        "$command cut-header.npy"
done <<'END'
star koksma-star
l2 koksma-l2
box koksma-box
edge koksma-edge
eval koksma-eval sum -q
error koksma-error --exact 0 -q
fit koksma-fit -x 1 -y 2
variation koksma-variation
cells koksma-cells -m samples
END
out="koksma-bound: standard input: cannot read:"
t closed-in-bound 1 "" "$out Bad file descriptor" 'koksma-bound f2 - <&-'
t closed-in-observe 1 "" "$out Bad file descriptor" 'koksma-bound f2 --observe - <&-'
t folder-bound 1 "" 'koksma-bound: folder: Is a directory' 'koksma-bound f2 folder'
t folder-in-bound 1 "" 'koksma-bound: standard input: Is a directory' \
    'koksma-bound f2 - <folder'

# ---- Memory: a sentence, and nothing half-written --------------------------------

# Where there is such a limit and the programs start within it: under sanitizers they
# do not.
if sh -c 'ulimit -v 60000 && koksma-star -V; exit $?' >/dev/null 2>&1; then
    # An array of as many points as are read of it.
    koksma-points grid -n 1 --npy | head -c 128 |
        sed 's/(1, 2), }       /(99999999, 2), }/' >header.npy
    while read -r name command; do
        has "memory-$name" 1 "^koksma-$name: .*not enough memory" "ulimit -v 60000; $command"
    done <<'END'
star cat header.npy /dev/zero | koksma-star
l2 cat header.npy /dev/zero | koksma-l2
box cat header.npy /dev/zero | koksma-box
edge cat header.npy /dev/zero | koksma-edge
cells cat header.npy /dev/zero | koksma-cells -m samples
eval cat header.npy /dev/zero | koksma-eval f2 --npy
points koksma-points latin -n 1e8
points koksma-points poisson -n 1e8
fit yes 1 1 | koksma-fit -x 1 -y 2
bound yes 1 1 | koksma-bound f2 --observe -
star tr '\0' 1 </dev/zero | koksma-star
star tr '\0' '#' </dev/zero | koksma-star
END
else
    echo "left out: the tools do not start in 60 MB"
fi

# ---- Signals: what is printed is true, whenever they come --------------------------

# interrupted NAME LOWER UPPER COMMAND: the interval in these columns has that of the
# whole job in it.  A job is interrupted at moments drawn from the seed, until that has
# stopped it as often as KOKSMA_TEST_SCALE says; most are stopped by the first.
interrupted() {
    name=$1 lower=$2 upper=$3 command=$4
    $command -v >whole 2>said # whose last word is how long it took
    seconds=$(sed -n 's/.* \([0-9.]*\) s$/\1/p' said | tail -n 1)
    seed=${KOKSMA_TEST_SEED:-1}$(echo "$name" | cksum | cut -c 1-5)
    scale=${KOKSMA_TEST_SCALE:-1}
    stopped=0
    for delay in $(awk -v seed="$seed" -v n=$((8 * scale)) -v most="$seconds" '
        BEGIN { srand(seed); for (; n > 0; n--) printf "%.3f\n", 0.8 * most * rand() }'); do
        [ "$stopped" -lt "$scale" ] || break
        $command >out 2>err & # words alone, so that $! is the tool
        ./caught $!
        sleep "$delay"
        { kill -INT $! && kill -INT $!; } 2>/dev/null
        wait $!
        check_interrupted $?
    done
    [ "$stopped" -eq "$scale" ] || {
        failures=$((failures + 1))
        echo "FAILED: interrupt-$name: $stopped jobs of $scale stopped, of $seconds s each"
    }
}

check_interrupted() { # STATUS
    wrong=$(paste whole out | awk -v l="$lower" -v u="$upper" '
        { columns = NF / 2; lower = $(columns + l); upper = $(columns + u) }
        NF % 2 || lower == "" || lower + 0 > $u + 0 ||
            (upper != "inf" && upper + 0 < $l + 0) { print }
        END { if (NR != 1) print NR " rows" }')
    case $1 in
    0 | 130) # 130: it came when the row was out, and ended the tool as any other.
        cmp -s whole out || wrong="status $1 without the whole row" ;;
    3)
        stopped=$((stopped + 1))
        grep -q '^koksma-[a-z0-9]*: [^:]*$' err || wrong="no sentence" ;;
    *) wrong="status $1" ;;
    esac
    [ -z "$wrong" ] && return
    failures=$((failures + 1))
    echo "FAILED: interrupt-$name after $delay s: $command"
    echo "$wrong"
    cat whole out err
}

koksma-points random -d 9 -n 400 >star
koksma-points random -d 9 -n 250 >fewer
koksma-points random -d 4 -n 160 >corners
koksma-points random -d 20 -n 800 >many
koksma-points halton -n 300000 --npy >lines
koksma-points random -d 5 -n 200 >box
koksma-points halton -n 1200 >strips
koksma-points halton -n 12000 >edge
koksma-points halton -n 3000 >turns
koksma-points random -d 50 -n 6000 --npy >pairs
koksma-points random -d 4 -n 30000 --npy >divide
interrupted star 3 4 'koksma-star -q -m tree star'
interrupted star-stages 3 4 'koksma-star -q -m tree -t 1e6 fewer'
interrupted star-search 3 4 'koksma-star -q -m search many'
interrupted star-sweep 3 4 'koksma-star -q -m sweep corners'
interrupted star-lines 3 4 'koksma-star -q -m lines lines'
interrupted box 3 4 'koksma-box -q box'
interrupted box-sweep 3 4 'koksma-box -q -m sweep strips'
interrupted edge 3 4 'koksma-edge -q edge'
interrupted edge-sweep 3 4 'koksma-edge -q -m sweep turns'
interrupted l2-pairs 3 4 'koksma-l2 -q -m pairs pairs'
interrupted l2-divide 3 4 'koksma-l2 -q -m divide divide'
interrupted cells 5 6 'koksma-cells -q ball -d 3 -n 2^29'

# A signal that nobody waits for ends a tool: while it reads, while it writes, and one
# that asks it to end.  timeout sends an interrupt that is not ignored, and sends it
# twice.
if timeout --preserve-status 9 true 2>/dev/null; then
    mkfifo stuck
    exec 5<>stuck
    now='timeout --preserve-status -s'
    t interrupt-reading 130 "" "" "$now INT 0.1 koksma-star <&5"
    # The rows of the sets before are out.
    t interrupt-between 130 "1${tab}1${tab}2${tab}1${tab}1" "" \
        "printf '0 0\n\n1 1\n' >&5; $now INT 1.5 koksma-star -q <&5"
    t interrupt-writing 130 "" "" "$now INT 0.1 koksma-points halton -n 2^40 >&5"
    koksma-points random -d 12 -n 2000 >long
    t terminate 143 "" "" "$now TERM 0.1 koksma-star -m tree long"
    # Killed while it still reads, or stopped: no row, or a whole one.
    t interrupt-twice 0 "" "" "$now INT 0.2 koksma-star -q -m tree long >row 2>said
        case \$? in 130) [ ! -s row ] ;; 3) grep -q '${tab}1\$' row ;; *) false ;; esac"
fi

rows_end
