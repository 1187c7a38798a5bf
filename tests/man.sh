#!/bin/sh
# Every manual page is clean mdoc, and each tool's page lists exactly the
# options that the tool's -h prints.
set -eu
: "${top_srcdir:=.}" "${top_builddir:=.}" "${MANDOC:=mandoc}"
status=0

if ! command -v "$MANDOC" >/dev/null 2>&1 || [ "$MANDOC" = : ]; then
    echo "There is no mandoc to check the manual pages with."
    exit 77
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# Pages of this package need not be installed for a page to name them.
lint() {
    "$MANDOC" -Tlint -Wstyle "$1" >"$scratch/lint" 2>&1 || : # it complains in words too
    ! grep -v 'referenced manual not found' "$scratch/lint" || status=1
}

# "  -x, --long ARG   help" gives -x and --long.
options_of_help() {
    awk '
    /^  +-/ {
        for (i = 1; i <= 2 && $i ~ /^-/; i++) {
            more = $i ~ /,$/
            sub(/[],=[].*/, "", $i)
            print $i
            if (!more) break
        }
    }' "$1" | sort -u
}

# ".It Fl x , Fl -long Ar arg" gives -x and --long.
options_of_page() {
    awk '
    $1 == ".It" && $2 == "Fl" {
        for (i = 2; i < NF; i++)
            if ($i == "Fl") print "-" $(i + 1)
    }' "$1" | sort -u
}

# A program is in the build tree, a script may be in the source tree.
find_tool() {
    for folder in "$top_builddir" "$top_srcdir"; do
        [ -x "$folder/bin/$1" ] && echo "$folder/bin/$1" && return
    done
    return 1
}

compare() { # PAGE
    tool=$(basename "$1" .1)
    if ! program=$(find_tool "$tool"); then
        echo "$1 describes $tool, which was not built."
        status=1
    elif ! "$program" -h >"$scratch/help"; then
        echo "$tool -h failed."
        status=1
    else
        options_of_help "$scratch/help" >"$scratch/of_help"
        options_of_page "$1" >"$scratch/of_page"
        diff "$scratch/of_help" "$scratch/of_page" >"$scratch/diff" && return
        echo "$1 and $tool -h differ (< -h alone, > the page alone):"
        grep '^[<>]' "$scratch/diff"
        status=1
    fi
}

for page in "$top_srcdir"/man/*.[1-9]; do
    lint "$page"
done
for page in "$top_srcdir"/man/*.1; do
    compare "$page"
done
for program in "$top_builddir"/bin/koksma-*; do
    tool=$(basename "$program")
    case $tool in *.*) continue ;; esac
    [ ! -f "$program" ] || [ -f "$top_srcdir/man/$tool.1" ] && continue
    echo "$tool has no manual page."
    status=1
done
exit $status
