#!/bin/sh
# A file of lib/ includes headers of its own floor or of a lower one, never of
# a higher; the measures on floor 2 do not include each other; and bin/ sees the
# public headers alone.  This is the picture in koksma(7), held to by a machine.
set -eu
: "${top_srcdir:=.}"
status=0

complain() {
    echo "$*"
    status=1
}

floor() {
    case $1 in
    num | num_* | points | error | student) echo 0 ;;
    rng | rng_* | io | io_* | gen | gen_* | integrand | integrand_* | part) echo 1 ;;
    tree | tree_*) echo 1 ;;
    star | star_* | l2 | l2_* | box | box_* | edge | edge_* | curve) echo 2 ;;
    variation | variation_* | cells | cells_*) echo 2 ;;
    fit | fit_* | scene | scene_* | bound) echo 3 ;;
    koksma | config) echo any ;; # the umbrella, and what configure found out
    *) echo none ;;
    esac
}

# A measure and its kernels share the stem up to the first underscore.
family() { echo "${1%%_*}"; }

# Names of the headers that a file includes, without <>, "" and koksma/.
includes() {
    sed -n 's/^[[:blank:]]*#[[:blank:]]*include[[:blank:]]*[<"]\([^>"]*\)[>"].*/\1/p' "$1" |
        sed 's|^koksma/||'
}

public_headers() {
    awk '
    /^koksmainclude_HEADERS/ { listed = 1 }
    listed { for (i = 1; i <= NF; i++) if (sub(/.*\//, "", $i)) print $i }
    !/\\$/ { listed = 0 }' "$top_srcdir/lib/local.mk"
}

check_lib_include() { # FILE OWN USED
    own_floor=$(floor "$2")
    used_floor=$(floor "$3")
    case $own_floor$used_floor in
    *none*) return ;; # told once a file, below
    any* | *any) return ;;
    esac
    if [ "$used_floor" -gt "$own_floor" ]; then
        complain "$1 includes $3.h, which stands above it."
    elif [ "$own_floor$used_floor" = 22 ] && [ "$(family "$2")" != "$(family "$3")" ]; then
        complain "$1 includes $3.h, but measures do not include each other."
    fi
}

check_lib_file() {
    stem=$(basename "$1" | sed 's/\.[ch]$//')
    [ "$(floor "$stem")" != none ] || complain "$1 is on no floor; give it one in tests/floors.sh."
    for name in $(includes "$1"); do
        [ ! -f "$top_srcdir/lib/$name" ] || check_lib_include "$1" "$stem" "${name%.h}"
    done
}

check_bin_file() {
    for name in $(includes "$1"); do
        [ "$name" != koksma.h ] || continue
        [ ! -f "$top_srcdir/lib/${name##*/}" ] && continue # the system's, or bin's own
        case " $public " in
        *" $name "*) ;;
        *) complain "$1 includes $name, which is private to lib/." ;;
        esac
    done
    ! grep -En '(^|[^[:alnum:]_])ki_' "$1" || complain "$1 uses a ki_ name, which is private to lib/."
}

public=$(public_headers | tr '\n' ' ')
if [ -z "$public" ]; then
    echo "lib/local.mk lists no koksmainclude_HEADERS."
    exit 1
fi
for file in "$top_srcdir"/lib/*.[ch]; do
    check_lib_file "$file"
done
for file in "$top_srcdir"/bin/*.[ch]; do
    check_bin_file "$file"
done
exit $status
