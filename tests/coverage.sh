#!/bin/sh
# coverage.sh FOLDER LEAST: how many of the lines of lib/ ran, a row a file, with the
# numbers of those that did not; FOLDER has the .gcda files.  Fails when the share of
# all is below LEAST per cent.  A header's line ran when it did in any file.
set -eu
"${GCOV:-gcov}" -t "$1"/*.gcda | awk -v least="$2" '
BEGIN { FS = ":" }
$3 == "Source" {
    file = $4
    sub(/.*\//, "", file)
    ours = $4 ~ /(^|\/)lib\/[^\/]*$/
    next
}
ours && $2 + 0 > 0 {
    gsub(/ /, "", $1)
    if ($1 == "-") next
    line = file ":" $2 + 0
    if (!(line in ran)) {
        ran[line] = 0
        if (!(file in lines)) order[++files] = file
        of[file] = of[file] " " line
        lines[file]++
    }
    if ($1 !~ /^[#=]/) ran[line] = 1
}
END {
    print "# per cent\tlines\tfile\tlines that did not run"
    for (i = 1; i <= files; i++) {
        file = order[i]
        left = ""
        missed = 0
        n = split(of[file], each, " ")
        for (j = 1; j <= n; j++)
            if (!ran[each[j]]) {
                sub(/.*:/, "", each[j])
                left = left " " each[j]
                missed++
            }
        printf "%.2f\t%d\t%s\t%s\n", 100 * (n - missed) / n, n, file, left
        all += n
        all_missed += missed
    }
    if (all == 0) { print "coverage.sh: no line of lib/ ran"; exit 1 }
    share = 100 * (all - all_missed) / all
    printf "%.2f\t%d\tall\n", share, all
    if (share < least) { print "coverage.sh: that is below " least; exit 1 }
}'
