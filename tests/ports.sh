#!/bin/bash
# Koksma by other compilers and on other machines, from a bootstrapped source tree:
#
#     tests/ports.sh [-n] [-o FOLDER] [TARGET]...      (all targets when none is named)
#
# builds each TARGET in FOLDER (ports/), passes its tests there, and compares what the
# tools answer with what this machine's own build answers, byte by byte.  -n only
# says what is missing.  Nothing is installed: a target whose tools are missing is
# skipped, and the line that installs them on Debian 12 is printed.
#
# The unit tests for other machines and C libraries need Check built for them:
# CHECK_SOURCE names a folder with Check's sources, as "apt-get source check" lays
# them down, and without it those targets run the scripts alone.
set -u
export LC_ALL=C
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=$PWD/ports
jobs=${JOBS:-$(nproc)}
only_missing=no

# NAME, COMPILER, HOST of configure, EMULATOR, CFLAGS; Debian's packages.
targets='
gcc-O0      gcc-12                  -                   -                    -O0
gcc-O2      gcc-12                  -                   -                    -O2
gcc-O3      gcc-12                  -                   -                    -O3
clang-O0    clang-14                -                   -                    -O0
clang-O2    clang-14                -                   -                    -O2
clang-O3    clang-14                -                   -                    -O3
gcc-own     gcc-12                  -                   -                    -O3 -march=native
clang-own   clang-14                -                   -                    -O3 -march=native
x87         gcc-12                  i686-linux-gnu      -                    -O2
m32         clang-16                i686-linux-gnu      -                    -O2
musl        musl-gcc                x86_64-linux-musl   -                    -O2
aarch64     aarch64-linux-gnu-gcc   aarch64-linux-gnu   qemu-aarch64-static  -O2
s390x       s390x-linux-gnu-gcc     s390x-linux-gnu     qemu-s390x-static    -O2'

packages() {
    case $1 in
    gcc-*) echo gcc-12 check ;;
    clang-*) echo clang-14 check ;;
    x87) echo gcc-12-multilib ;;
    m32) echo clang-16 gcc-12-multilib ;;
    musl) echo musl-tools ;;
    aarch64) echo gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user-static ;;
    s390x) echo gcc-s390x-linux-gnu libc6-dev-s390x-cross qemu-user-static ;;
    esac
}

usage() {
    sed -n '2,14s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
    exit "$1"
}

have() { command -v "$1" >/dev/null 2>&1; }

skip() { printf '%-9s skipped: %s\n' "$name" "$*"; }

# A compiler that makes a program for the target.
compiles() {
    have "${compiler%% *}" && echo 'int main(void) { return 0; }' |
        $compiler -x c - -o "$folder/probe" >/dev/null 2>&1
}

# Debian keeps the headers of both widths of x86 in one folder that only the package
# gcc-multilib, which excludes all cross compilers, makes the ordinary one.
x86_32() { echo "$1 -m32 $2 -idirafter /usr/include/x86_64-linux-gnu"; }

# ---- Check for the target, and the target's programs for the scripts -----------

build_check() { # for $host, into $root
    mkdir -p "$folder/check-$name"
    (
        cd "$folder/check-$name" || exit 1
        "$CHECK_SOURCE/configure" CC="$compiler" --host="$host" --prefix="$root" \
            --disable-shared --disable-subunit --disable-build-docs &&
            make -C lib && make -C src install && make install-data
    ) >"$folder/check-$name.log" 2>&1
}

# The scripts find the tools on PATH: under an emulator, scripts that start it.
wrap_tools() { # BUILD
    local tool
    mkdir -p "$1/emulated"
    for tool in "$1"/bin/koksma-*; do
        case $tool in
        *.o) continue ;;
        *-plot) ln -sf "$tool" "$1/emulated/" ;;
        *)
            printf '#!/bin/sh\nexec %s %s "$@"\n' "$emulator" "$tool" \
                >"$1/emulated/${tool##*/}"
            chmod +x "$1/emulated/${tool##*/}"
            ;;
        esac
    done
}

# ---- Building and testing --------------------------------------------------------

configure() { # for the target, in the folder where we are
    local options=(-q CC="$compiler" CFLAGS="$cflags")
    [ "$host" = - ] || options+=(--disable-shared --host="$host" PKG_CONFIG=pkg-config
        PKG_CONFIG_LIBDIR="$root/lib/pkgconfig")
    "$source_dir/configure" "${options[@]}"
}

run_tests() { # what differs from an ordinary make check, for those who are slow
    local environment='' wrapper=''
    export CK_TIMEOUT_MULTIPLIER=20
    if [ "$emulator" != - ]; then
        export QEMU_LD_PREFIX=/usr/${host}
        export CK_EXCLUDE_TAGS='big slow'
        wrap_tools "$PWD"
        environment="PATH=$PWD/emulated:\$\$PATH; export PATH; EMULATOR=$emulator; export EMULATOR;"
        wrapper=$emulator
    fi
    make -k -s -j"$jobs" check TESTS_ENVIRONMENT="$environment" LOG_COMPILER="$wrapper"
}

counts() { # of make check's log: tests that passed, were skipped, failed
    awk '/^# (PASS|SKIP|FAIL|ERROR):/ { n[$2] += $3 }
    END { printf "%d passed, %d skipped, %d failed", n["PASS:"], n["SKIP:"],
        n["FAIL:"] + n["ERROR:"] }' "$1"
}

# ---- The same answers on every machine ------------------------------------------

# What is made, evaluated and measured on every machine alike, to the last bit.  Not
# among it: oscillatory and sphere-shoot-sum, in which the C library's sines and
# cosines take part.
answers() { # FOLDER OF TOOLS
    local name
    (
        PATH=$1:$PATH
        cd "$folder/sets" || exit 1
        for name in halton rsequence richtmyer niederreiter random latin poisson; do
            koksma-points $name -d 2 -n 64
        done
        for name in digits owen shift; do
            koksma-points sobol -d 5 -n 256 --scramble $name -s 3
        done
        koksma-points halton -d 3 -n 50 --npy | od -An -tx1
        for name in f2 halfspace sum gaussian ball koch fractal2 sphere; do
            koksma-eval $name halton-2d.txt
        done
        for name in *.txt *.npy; do
            koksma-star -q -w "$name"
            koksma-box -q -w "$name"
            case $name in *-2d.*) koksma-edge -q -w "$name" ;; esac
        done
        for name in star extreme centered wraparound symmetric mixture periodic; do
            koksma-l2 -q -k $name -- *.txt
        done
    ) 2>&1
}

make_sets() { # by this machine's own build
    local family
    mkdir -p "$folder/sets"
    (
        PATH=$1:$PATH
        cd "$folder/sets" || exit 1
        for family in halton random; do
            koksma-points $family -d 2 -n 100 --start 1 >$family-2d.txt
            koksma-points $family -d 3 -n 60 --start 1 >$family-3d.txt
            koksma-points $family -d 2 -n 1000 --start 1 >$family-1000-2d.txt
        done
        koksma-points halton -d 2 -n 100 --npy >little-2d.npy
    )
}

compare() { # with the native answers
    local tools=$build/bin
    [ "$emulator" = - ] || tools=$build/emulated
    answers "$tools" >"$folder/$name.answers"
    if cmp -s "$folder/native.answers" "$folder/$name.answers"; then
        echo "same answers"
    else
        echo "ANSWERS DIFFER: diff $folder/native.answers $folder/$name.answers"
        return 1
    fi
}

native() { # a build to compare with
    build=$folder/native
    mkdir -p "$build"
    (cd "$build" && { [ -f Makefile ] || "$source_dir/configure" -q --disable-shared; } &&
        make -s -j"$jobs") \
        >"$folder/native.log" 2>&1 ||
        { echo "ports.sh: this machine's own build failed; see $folder/native.log" >&2; exit 1; }
    make_sets "$build/bin"
    answers "$build/bin" >"$folder/native.answers"
}

# ---- One target -------------------------------------------------------------------

# configure has to refuse arithmetic that rounds twice.
refused() {
    mkdir -p "$build"
    if (cd "$build" && configure) >"$folder/$name.log" 2>&1; then
        echo "$name       FAILED: configure takes x87 arithmetic"
        return 1
    fi
    if ! grep -q 'need operations that round once' "$folder/$name.log"; then
        echo "$name       FAILED: configure, for another reason; see $folder/$name.log"
        return 1
    fi
    echo "$name       refused by configure, as it should be"
}

port() {
    local begin=$SECONDS result note='' same
    build=$folder/$name root=$folder/root-$name
    case $name in
    m32) compiler=$(x86_32 "$compiler" '-msse2 -mfpmath=sse') ;;
    x87) compiler=$(x86_32 "$compiler" '-mfpmath=387') ;;
    musl) compiler="$compiler -static" ;;
    esac
    if ! compiles || { [ "$emulator" != - ] && ! have "$emulator"; }; then
        skip "apt-get install --no-install-recommends $(packages "$name")"
        return
    fi
    [ "$only_missing" = yes ] && return
    [ "$name" = x87 ] && { refused; return; }
    if [ "$host" != - ] && [ ! -f "$root/lib/libcheck.a" ]; then
        if [ -z "${CHECK_SOURCE-}" ]; then
            note=', the unit tests left out (CHECK_SOURCE is not set)'
        else
            build_check || note=", the unit tests left out (see $folder/check-$name.log)"
        fi
    fi
    mkdir -p "$build"
    if ! (cd "$build" && { [ -f Makefile ] || configure; } && make -s -j"$jobs") >"$folder/$name.log" 2>&1; then
        printf '%-9s FAILED to build: see %s\n' "$name" "$folder/$name.log"
        return 1
    fi
    (cd "$build" && run_tests) >"$folder/$name.check" 2>&1
    result=$?
    same=$(compare) || result=1
    printf '%-9s %s%s; %s; %d s\n' "$name" "$(counts "$folder/$name.check")" "$note" \
        "$same" $((SECONDS - begin))
    return $result
}

while getopts no:h option; do
    case $option in
    n) only_missing=yes ;;
    o) folder=$OPTARG ;;
    h) usage 0 ;;
    *) usage 2 >&2 ;;
    esac
done
shift $((OPTIND - 1))
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
for name in "$@"; do
    grep -q "^$name " <<<"$targets" || { echo "ports.sh: there is no target $name" >&2; exit 2; }
done

status=0
[ "$only_missing" = yes ] || native
while read -r name compiler host emulator cflags; do
    [ -n "$name" ] || continue
    [ $# -eq 0 ] || [[ " $* " == *" $name "* ]] || continue
    port </dev/null || status=1
done <<<"$targets"
exit $status
