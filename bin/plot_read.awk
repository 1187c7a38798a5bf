# Reads the tables, and keeps of each what is to be drawn, as lines of
# "x y lower upper other"; other is the column mc, or the value at a point.

function stop(text) {
    print "koksma-plot: " text | "cat >&2"
    exit failed = 1
}

function is_number(text) {
    return text ~ /^[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?$/
}

# ---- Columns ----

function forget_names(    i) {
    for (i in column) delete column[i]
    for (i in names) delete names[i]
    named = 0
    FS = " "
}

# The last such line before the rows counts; those of koksma itself name nothing.
function read_names(text,    i) {
    if (text ~ /^#[ \t]*koksma/) return
    forget_names()
    sub(/^#[ \t]*/, "", text)
    sub(/[ \t]+$/, "", text)
    named = split(text, names, /[ \t,]+/)
    for (i = named; i > 0; i--)
        column[names[i]] = i
    if (has("input") || has("file")) FS = "\t" # file names may hold anything else
}

function has(name) { return name in column }

function first_of(wanted,    list, count, i) {
    count = split(wanted, list, " ")
    for (i = 1; i <= count; i++)
        if (has(list[i])) return column[list[i]]
    return 0
}

function chosen(text, otherwise) {
    if (text == "")
        return first_of(otherwise)
    if (text ~ /^[1-9][0-9]*$/)
        return text + 0
    if (!has(text))
        stop(place ": " (named == 0 ? \
            "no line names the columns: give a number from 1, not \"" text "\"" : \
            "no column is called \"" text "\""))
    return column[text]
}

function label(at,    name) {
    name = at in names ? names[at] : kind == "points" ? "x" at : "column " at
    if (name == "n") return "N"
    if (name == "rms") return "root mean square error"
    if (name == "tail") return "largest error after N samples"
    if (name == "error") return "|error|"
    if (name == "upper" || name == "lower") return "discrepancy"
    return name
}

# What the names of the columns say the table is, and the columns that are drawn.
function recognise() {
    low = high = other = input = 0
    if (has("exponent") && has("constant")) {
        kind = "fit"
        return
    }
    at_x = chosen(ENVIRON["KOKSMA_X"], "N n seconds x1")
    at_y = chosen(ENVIRON["KOKSMA_Y"], has("x1") ? "x2" : "rms tail upper error")
    if (named == 0 && at_x == 0) at_x = 1
    if (named == 0 && at_y == 0) at_y = 2
    if (at_x == 0 || at_y == 0)
        stop(place ": it is not clear which columns to draw; say so by -x and -y")
    kind = named == 0 || has("x1") ? "points" : names[at_x] == "seconds" ? "trace" : \
        names[at_x] ~ /^[Nn]$/ ? "curve" : "plain"
    if (kind == "points" && named > 0 && names[named] !~ /^x[0-9]+$/) other = named
    if (kind != "curve" && kind != "trace") return
    if (has("lower") && has("upper") && names[at_y] !~ /^(error|tail|mc)$/) {
        low = column["lower"]
        high = column["upper"]
    }
    if (has("mc")) other = column["mc"]
    if (has("input")) input = column["input"]
}

function begin_table() {
    recognise()
    if (kind == "fit") return
    if (figure == "") {
        figure = kind
        label_x = label(at_x)
        label_y = label(at_y)
        logs = ENVIRON["KOKSMA_LOG"]
        if (logs == "" && kind ~ /^(curve|trace)$/) logs = "xy"
        if (logs == "none") logs = ""
    }
    if (figure != kind)
        stop(place ": a table of another kind than the one before it")
    table_name[++tables] = place
    has_band[tables] = low > 0
    has_other[tables] = other > 0
    new_curve = 1
}

# ---- Rows ----

# Appending to one long string would take time that grows with its square.
function keep(text) {
    chunk = chunk text
    if (length(chunk) > 4096) end_chunk()
}

function end_chunk() {
    chunks[tables, ++chunk_count[tables]] = chunk
    chunk = ""
}

function number(at) {
    if (at > NF)
        stop(place ":" line ": " NF (NF == 1 ? " column" : " columns") \
            ", but column " at " is wanted")
    if (tolower($at) ~ /^[-+]?(nan|inf)/)
        return "NaN"
    if (!is_number($at))
        stop(place ":" line ": column " at " is \"" substr($at, 1, 40) \
            "\", not a decimal number")
    return $at
}

# A logarithmic axis has no place for what is not above 0.
function shown(v, axis) {
    return v == "NaN" || index(logs, axis) == 0 || v + 0 > 0 ? v : "NaN"
}

function begin_curve() {
    if (++curves[tables] > 1) keep("\n")
    if (input > 0 && $input !~ /^[0-9]+$/)
        curve_name[tables, curves[tables]] = $input
    new_curve = 0
}

# Another set begins where x falls back, or, of points, behind a blank line.
function add_row(    x, y, l, u) {
    x = number(at_x)
    y = number(at_y)
    if (kind == "trace" && x + 0 == 0) x = 0.001 # what the column can tell from 0
    if (kind == "curve") sub(/^-/, "", y)
    if (new_curve || kind == "curve" && x + 0 <= last_x || kind == "trace" && x + 0 < last_x)
        begin_curve()
    last_x = x + 0
    x = shown(x, "x")
    y = shown(y, "y")
    if (x != "NaN" && y != "NaN") drawn++
    l = low > 0 ? shown(number(low), "y") : "NaN"
    u = low > 0 ? shown(number(high), "y") : "NaN"
    if (l == "NaN" || u == "NaN") l = u = "NaN"
    keep(x " " y " " l " " u " " (other > 0 ? shown(number(other), "y") : "NaN") "\n")
}

# ---- Fits ----

function of_fit(name) {
    if (!has(name)) stop(place ": no column is called \"" name "\"")
    return number(column[name])
}

function words_of_fit(    text, verdict) {
    text = sprintf("%s %.3f", $column["model"] ~ /^two/ ? "exponent" : "slope", \
        of_fit("exponent"))
    if (of_fit("lower") != "NaN")
        text = text sprintf(" [%.3f, %.3f]", of_fit("lower"), of_fit("upper"))
    verdict = has("verdict") ? $column["verdict"] : ""
    if (verdict == "equivalent" || verdict == "different")
        text = text ", " verdict (verdict == "different" ? " from " : " to ") \
            sprintf("%.4g", of_fit("claim"))
    if (verdict == "undecided")
        text = text ", undecided" (has("doubt") ? ": " $column["doubt"] : "")
    return has("doubt") && $column["doubt"] == "path" ? text ", one path" : text
}

# The fitted curve over the window of the fit; with two terms they add up as squares.
function add_fit(    from, to, second, i, x, y) {
    fit_words[++fits] = words_of_fit()
    from = log(of_fit("from"))
    to = log(of_fit("to"))
    second = $column["model"] ~ /^two/ ? of_fit("smooth") : 0
    for (i = 0; i <= 60; i++) {
        x = exp(from + i / 60 * (to - from))
        y = (of_fit("constant") * x ^ of_fit("exponent")) ^ 2 + \
            (second / x) ^ 2 * ($column["model"] == "two-terms" ? log(x) : 1)
        fit_data[fits] = fit_data[fits] sprintf("%.9g %.9g\n", x, sqrt(y))
    }
    drawn++
}

# ---- Files ----

function read_file(file,    source, got, rows) {
    place = file == "-" ? "standard input" : file
    source = file == "-" ? "/dev/stdin" : file
    line = rows = 0
    forget_names()
    while ((got = (getline <source)) > 0) {
        if (++line == 1 && $0 ~ /^.NUMPY/)
            stop(place ": an .npy file, and koksma-plot reads text")
        sub(/\r$/, "")
        if (/^#/) {
            if (rows == 0) read_names($0)
            continue
        }
        if (FS == " ") {
            sub(/#.*/, "")
            gsub(/,/, " ")
        }
        if (NF == 0) {
            if (rows > 0 && kind ~ /^(points|plain)$/) new_curve = 1
            continue
        }
        if (rows++ == 0) begin_table()
        if (kind == "fit") add_fit()
        else add_row()
    }
    if (got < 0) stop(place ": cannot read")
    if (file != "-") close(source)
    if (rows == 0) stop(place ": no rows to draw")
    end_chunk()
}

BEGIN {
    for (f = 1; f < ARGC; f++)
        read_file(ARGV[f])
    if (drawn == 0) stop("there is nothing that these axes could show")
    write_script(ENVIRON["KOKSMA_FORM"])
    exit
}
END { exit failed }
