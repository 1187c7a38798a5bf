#!/bin/sh
# The shared library exports exactly what the public headers declare.
set -eu
: "${top_srcdir:=.}" "${top_builddir:=.}" "${NM:=nm}"
library=$top_builddir/lib/.libs/libkoksma.so

skip() {
    echo "$*"
    exit 77
}
[ -f "$library" ] || skip "There is no shared library to look into."
command -v "${NM%% *}" >/dev/null 2>&1 || skip "There is no $NM to look into the library with."

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

public_headers() {
    awk '
    /^koksmainclude_HEADERS/ { listed = 1 }
    listed { for (i = 1; i <= NF; i++) if (sub(/.*\//, "", $i)) print $i }
    !/\\$/ { listed = 0 }' "$top_srcdir/lib/local.mk"
}

# Remove what declares nothing: comments, preprocessor lines, extern "C", and
# everything between braces, then put one declaration on a line.
declarations() {
    awk '
    function without_comments(s,    kept, mark) {
        while (match(s, /\/[*\/]/)) {
            kept = kept substr(s, 1, RSTART - 1) " "
            mark = substr(s, RSTART + 1, 1)
            s = substr(s, RSTART + 2)
            s = mark == "*" ? substr(s, index(s, "*/") + 2) : substr(s, index(s, "\n"))
        }
        return kept s
    }
    function code_lines(s,    line, n, i, kept, macro) {
        n = split(s, line, "\n")
        for (i = 1; i <= n; i++) {
            if (!macro && line[i] !~ /^[ \t]*(#|extern "C" *\{)/) kept = kept line[i] " "
            else macro = line[i] ~ /\\$/ # which goes on
        }
        return kept
    }
    { text = text $0 "\n" }
    END {
        text = code_lines(without_comments(text))
        for (i = 1; i <= length(text); i++) {
            c = substr(text, i, 1)
            if (c == "{") depth++
            else if (c == "}") { if (depth > 0 && --depth == 0) printf "{}" }
            else if (depth > 0) continue
            else if (c == ";") print ""
            else printf "%s", c
        }
    }' "$1"
}

# The names that a header promises to link: functions, and extern objects.  An
# inline function ends in {} without a semicolon, so what follows it stands on
# its line.
declared() {
    declarations "$1" | awk '
    {
        while (match($0, /^[^{]*static[^{]*\{\}/)) $0 = substr($0, RLENGTH + 1)
        if ($1 == "typedef" || $1 == "static") next
        if (match($0, /koksma_[a-z0-9_]*[ \t]*\(/))
            name = substr($0, RSTART, RLENGTH - 1)
        else if ($1 == "extern" && match($0, /koksma_[a-z0-9_]*[ \t]*(\[.*)?[ \t]*$/)) {
            name = substr($0, RSTART)
            sub(/\[.*/, "", name)
        } else next
        gsub(/[ \t]/, "", name)
        print name
    }'
}

for header in koksma.h $(public_headers); do
    declared "$top_srcdir/lib/$header"
done | sort -u >"$scratch/declared"

# The last five belong to the linker, where it shows them.
$NM -D --defined-only "$library" | awk '{ sub(/@.*/, "", $NF); print $NF }' |
    grep -Ev '^(_init|_fini|_end|_edata|__bss_start)$' | sort -u >"$scratch/exported"

if [ ! -s "$scratch/declared" ]; then
    echo "The public headers declare no function at all, as far as $0 can see."
    exit 1
fi
status=0
for name in $(comm -23 "$scratch/exported" "$scratch/declared"); do
    echo "The library exports $name, which no public header declares."
    status=1
done
for name in $(comm -13 "$scratch/exported" "$scratch/declared"); do
    echo "A public header declares $name, which the library does not export."
    status=1
done
exit $status
