#!/bin/sh
# trade_report.sh TABLES: the tables of trade.sh and bench_radical in a page, which is
# the one under FIGURES of koksma-trade(7).
# shellcheck disable=SC2016 # what is in single quotes is for awk
set -eu
cd "$1"

# of TABLE PROGRAM: awk over its rows.  The program puts values into a table by the
# names of rows, new ones below, and the numbers of columns, and writes it by lines().
of() {
    awk -F '\t' '
    function short(v) { return sprintf(v < 0.0095 ? "%.1g" : v < 99.5 ? "%.2g" : "%.0f", v) }
    function put(row, column, value) {
        if (!(row in at)) name[at[row] = ++rows] = row
        table[at[row], column] = value
        if (column > columns) columns = column
    }
    function lines(title, first, width,    i, j, line) {
        print title
        for (i = 1; i <= rows; i++) {
            line = sprintf("%-" first "s", "  " name[i])
            for (j = 1; j <= columns; j++) line = line sprintf("%" width "s", table[i, j])
            sub(/ +$/, "", line)
            print line
        }
        print ""
    }
    /^#/ { next }
    '"$2" "$1.tsv"
}

of trade_star_tolerance '
    BEGIN {
        count = split("4 1 0.5 0.25 0.1 0.02 0", e, " ")
        for (j = 1; j <= count; j++) put("-e", j, e[j])
    }
    { for (j = 1; j <= count; j++) if ($2 == e[j]) put($1, j, short($3)) }
    END { lines("koksma-star -e: seconds", 22, 8) }'
of trade_star_time '
    BEGIN {
        count = split("0.1 0.2 0.5 1 2 5", t, " ")
        for (j = 1; j <= count; j++) put("-t", j, t[j])
    }
    { ratio = $5 == 1 ? "none" : $6 < 1e-9 ? "exact" : short($5 / $4) }
    { for (j = 1; j <= count; j++) if ($2 == t[j]) put($1, j, ratio) }
    END { lines("koksma-star -t: upper/lower after so many seconds by the clock", 22, 8) }'
of trade_star_search '
    BEGIN { put("", 1, "runs"); put("", 2, "best"); put("", 3, "within 1%")
        put("", 4, "last find"); put("", 5, "the end") }
    !($1 in n) { order[++count] = $1; n[$1] = 0 }
    { key = $1 SUBSEP $2 }
    !(key in all) { n[$1]++ }
    $5 > last[key] { last[key] = $5; when[key] = $3 }
    $5 > best[$1] { best[$1] = $5 }
    { all[key] = $3 }
    END {
        for (key in last) {
            split(key, k, SUBSEP)
            found[k[1]] += last[key] == best[k[1]]
            near[k[1]] += last[key] >= 0.99 * best[k[1]]
            late[k[1]] += when[key] / n[k[1]]
            sum[k[1]] += all[key] / n[k[1]]
        }
        for (i = 1; i <= count; i++) {
            p = order[i]
            put(p, 1, n[p]); put(p, 2, found[p]); put(p, 3, near[p])
            put(p, 4, short(late[p])); put(p, 5, short(sum[p]))
        }
        lines("koksma-star -m search: how many of the runs find the best of all, or nearly;\n" \
            "mean seconds until the last find, and until the end", 22, 10)
    }'
of trade_l2_method '
    BEGIN {
        split("1024 32768 1048576", n, " ")
        split("2^10 2^15 2^20", label, " ")
        for (j = 1; j <= 3; j++) { put("n", j, label[j]); put("n", 3 + j, label[j]) }
    }
    {
        for (j = 1; j <= 3; j++)
            if ($3 == n[j]) {
                put($1 ", dim " $2, j, short($4))
                put($1 ", dim " $2, 3 + j, sprintf("%.0e", $7))
            }
    }
    END { lines("koksma-l2 -m: seconds; width of the interval as a share of the value", 18, 9) }'
of trade_cells_lines '
    BEGIN {
        split("100 1000 10000", l, " ")
        put("--lines", 4, "exact")
        for (j = 1; j <= 3; j++) { put("--lines", j, l[j]); put("--lines", 4 + j, l[j]) }
    }
    $4 == 16777216 {
        row = "ball, dim " $2
        if ($1 == "exact") put(row, 4, short($5))
        for (j = 1; j <= 3; j++)
            if ($3 == l[j]) { put(row, j, short($5)); put(row, 4 + j, short($11)) }
    }
    END { lines("koksma-cells of 2^24 cells: seconds; width as a share of the value", 18, 8) }'
of trade_variation_cells '
    BEGIN { split("4 16 64 256", c, " "); for (j = 1; j <= 4; j++) put("--cells", j, c[j]) }
    $1 == "grid" { for (j = 1; j <= 4; j++) if ($3 == c[j]) put("gaussian, dim " $2, j, short($10)) }
    END { lines("koksma-variation: the share of the variation that the grid lacks", 18, 9) }'
of trade_variation_cells '
    $1 == "random" {
        j++
        put("--samples", j, "2^" log($4) / log(2))
        put("seconds", j, short($5))
        put("width", j, short($11))
    }
    END { lines("koksma-variation -m random, gaussian, dim 6: width as a share of V_k", 18, 9) }'
of trade_fit_replicates '
    !($1 in n) { order[++count] = $1 }
    { n[$1]++; sum[$1] += $3; width[$1] += $7 }
    END {
        for (j = 1; j <= count; j++) {
            r = order[j]
            put("--replicates", j, r)
            put("seconds", j, short(sum[r] / n[r]))
            put("width", j, short(width[r] / n[r]))
        }
        lines("koksma-fit of f2, N to 2^14: width of the interval, mean of five seeds", 18, 8)
    }'
of trade_text_npy '
    $2 == 1000000 {
        j++
        put("", j, $1)
        put("ns a point, writing", j, short(1e9 * $3 / $2))
        put("ns a point, reading", j, short(1e9 * $4 / $2))
        put("bytes a point", j, short($5 / $2))
    }
    END { lines("a million points in the plane, of koksma-points and by koksma-error", 26, 8) }'
of radical '
    !($2 in column) { column[$2] = ++count; put("base", count, $2); put("base", 5 + count, $2) }
    { put($1, column[$2], short($5)); put($1, 5 + column[$2], $6 == "nan" ? "" : short($6)) }
    END { lines("radical inverses: ns a point; largest error in units in the last place", 12, 6) }'
