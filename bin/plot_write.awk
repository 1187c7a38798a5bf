# Writes the gnuplot script: how the picture looks, the data, the plot command.

# In single quotes gnuplot takes every character for itself but the quote.
function quoted(text) {
    gsub(/\047/, "\047\047", text)
    gsub(/[[:cntrl:]]/, " ", text)
    return "\047" text "\047"
}

function colour(i,    list) {
    split("#0072b2 #d55e00 #009e73 #cc79a7 #e69f00 #56b4e9 #7f3c8d #666666", list, " ")
    return " lc rgb \047" list[(i - 1) % 8 + 1] "\047"
}

# ---- What is drawn ----

function element(what, key) {
    elements = elements (elements == "" ? "plot " : ", ") what " title " quoted(key)
    if (key != "") keys++
}

function style(    name) {
    if (figure == "points") return " with points pt 7 ps 0.5"
    if (figure == "trace") return " with steps lw 2"
    return " with linespoints lw 1.5 pt 7 ps 0.6"
}

function draw_set(t, data, hue, key) {
    if (figure == "trace" && has_band[t]) {
        element(data " using 1:3" style() " dt 2" hue, key ": lower")
        key = key ": upper"
    } else if (has_band[t] && !as_text)
        element(data " using 1:3:4 with filledcurves fs transparent solid 0.25 noborder" \
            hue, "")
    if (figure == "points" && has_other[t] && !as_text)
        element(data " using 1:2:5" style() " palette", key)
    else
        element(data " using 1:2" style() hue, key)
}

function name_of(t, s) {
    if ((t, s) in curve_name) return curve_name[t, s]
    return curves[t] == 1 ? table_name[t] : table_name[t] ":" s
}

# Up to 8 sets of a table are told apart.  Where each table has a fit, one key says both.
function draw_table(t,    s, data, words, key) {
    data = "$table" t
    words = fits == tables ? ": " fit_words[t] : ""
    if (curves[t] > 8)
        draw_set(t, data, colour(hues += 1), table_name[t] ", " curves[t] " sets" words)
    else
        for (s = 1; s <= curves[t]; s++) {
            draw_set(t, data " every :::" s - 1 "::" s - 1, colour(hues += 1), \
                name_of(t, s) words)
        }
    if (tables == 1 && figure == "curve" && has_other[t])
        element(data " every :::0::0 using 1:5 with lines dt 3 lw 2 lc rgb \047#777777\047", \
            "random points, sigma/sqrt(N)")
}

function draw_all(    i) {
    for (i = 1; i <= tables; i++)
        draw_table(i)
    for (i = 1; i <= fits; i++)
        element("$fit" i " with lines lw 1.5 dt 2 lc rgb \047black\047", \
            fits == tables ? "" : fit_words[i])
}

# ---- How it looks ----

function write_terminal(form,    height) {
    height = (figure == "points" ? 800 : 600) + 20 * keys
    if (form == "svg")
        print "set terminal svg size 900," height " font \047sans,15\047" \
            " background rgb \047white\047"
    else if (form == "png") {
        print "if (strstrt(GPVAL_TERMINALS, \047pngcairo\047)) { set terminal pngcairo" \
            " size 1350," 1.5 * height " fontscale 1.5 font \047sans,10\047 }"
        print "else { set terminal png size 1350," 1.5 * height " }"
    } else
        print "set terminal dumb noenhanced size 79,24"
}

function write_look() {
    print "set encoding utf8"
    if (ENVIRON["KOKSMA_TITLE"] != "")
        print "set title " quoted(ENVIRON["KOKSMA_TITLE"]) " noenhanced"
    print "set xlabel " quoted(label_x) (as_text ? "" : ".\"\\n \"") " noenhanced"
    print "set ylabel " quoted(label_y) " noenhanced"
    print "set key bmargin left vertical maxcols 1 Left reverse samplen 2 noenhanced"
    if (!as_text) print "set grid lt 1 lw 0.5 lc rgb \047#dddddd\047"
    if (figure == "points" && !as_text) print "set size ratio -1"
    write_axis("x")
    write_axis("y")
}

function write_axis(axis) {
    if (index(logs, axis) == 0) return
    print "set logscale " axis
    if (axis == "x") print "set xrange [*:*] noextend"
    print "set format " axis (as_text ? " \047%g\047" : " \04710^{%L}\047")
}

function write_block(name, text) {
    print name " << KOKSMA_END"
    printf "%s", text
}

function write_data(    t, i) {
    for (t = 1; t <= tables; t++) {
        write_block("$table" t, "")
        for (i = 1; i <= chunk_count[t]; i++)
            printf "%s", chunks[t, i]
        print "KOKSMA_END"
    }
    for (i = 1; i <= fits; i++) {
        write_block("$fit" i, fit_data[i])
        print "KOKSMA_END"
    }
}

function write_script(form) {
    as_text = form == "dumb"
    if (figure == "") { # fits alone
        logs = "xy"
        label_x = "N"
        label_y = "error"
    }
    draw_all()
    write_terminal(form)
    write_look()
    write_data()
    print elements
}
