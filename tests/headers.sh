#!/bin/sh
# Every public header compiles alone, as it will be installed and under a
# stranger's flags, and the umbrella has them all.
set -eu
: "${top_srcdir:=.}" "${CC:=cc}" "${CPPFLAGS:=}"
status=0

public_headers() {
    awk '
    /^koksmainclude_HEADERS/ { listed = 1 }
    listed { for (i = 1; i <= NF; i++) if (sub(/.*\//, "", $i)) print $i }
    !/\\$/ { listed = 0 }' "$top_srcdir/lib/local.mk"
}

# The installed layout, so that a header that includes a private one, or one by
# a path of the source tree, is found out.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/koksma"
headers=$(public_headers)
for header in $headers; do
    cp "$top_srcdir/lib/$header" "$scratch/koksma/"
done
cp "$top_srcdir/lib/koksma.h" "$scratch/"

compile() { # HEADER as a user includes it; twice, as guards are for that
    printf '#include <%s>\n#include <%s>\nint dummy;\n' "$1" "$1" >"$scratch/alone.c"
    # shellcheck disable=SC2086 # one word a flag
    $CC $CPPFLAGS -std=c11 -Wall -Wextra -Werror -I"$scratch" -c \
        -o "$scratch/alone.o" "$scratch/alone.c" && return
    echo "<$1> does not compile alone."
    status=1
}

if [ -z "$headers" ]; then
    echo "lib/local.mk lists no koksmainclude_HEADERS."
    exit 1
fi
for header in $headers; do
    compile "koksma/$header"
    grep -q "^#include [<\"]koksma/${header}[>\"]" "$scratch/koksma.h" && continue
    echo "koksma.h does not include $header."
    status=1
done
compile koksma.h
exit $status
