#!/bin/sh
# koksma-plot: draw the tables of the other tools with gnuplot.
#
# An awk program reads all the input and writes a gnuplot script with the data in
# it, so that nothing is read twice, no file name has to pass through gnuplot, and no
# temporary file is needed.  Nothing is drawn before all of it made sense.
set -u
export LC_ALL=C
tool=koksma-plot

usage() {
    cat <<'END'
usage: koksma-plot [OPTION]... [FILE]...
Draw points, errors, discrepancies, fits and traces with gnuplot.

  -x, --column-x COLUMN        name or number of the column across
  -y, --column-y COLUMN        that of the column up
  -o, --output FILE            FILE.svg or FILE.png to write (default: text)
      --log AXES               logarithmic: x, y, xy or none (default: as it suits)
      --title TEXT             a line above the picture
  -h, --help                   print this help
  -V, --version                print the version

man koksma-plot says more.
END
}

fail() {
    printf '%s: %s\n' "$tool" "$*" >&2
    exit 1
}

misuse() {
    printf '%s: %s\nTry '\''%s -h'\''.\n' "$tool" "$*" "$tool" >&2
    exit 2
}

# ---- Options -----------------------------------------------------------------------

column_x='' column_y='' output='' log='' title=''

set_option() { # NAME ARGUMENT
    case $1 in
    x | column-x) column_x=$2 ;;
    y | column-y) column_y=$2 ;;
    o | output) output=$2 ;;
    log) log=$2 ;;
    title) title=$2 ;;
    esac
}

# Takes the option $1, and $2 if that is its argument; $taken says how many.
read_option() {
    taken=1
    case $1 in
    -h | --help) usage && exit ;;
    -V | --version) echo "$tool (koksma) @PLOT_VERSION@" && exit ;;
    --column-x=* | --column-y=* | --output=* | --log=* | --title=*)
        name=${1%%=*}
        set_option "${name#--}" "${1#*=}"
        ;;
    -[xyo] | --column-x | --column-y | --output | --log | --title)
        [ $# -gt 1 ] || misuse "option '$1' requires an argument"
        name=${1#-}
        set_option "${name#-}" "$2"
        taken=2
        ;;
    -[xyo]*)
        name=${1#-}
        set_option "${name%"${name#?}"}" "${name#?}"
        ;;
    *) misuse "unrecognized option '$1'" ;;
    esac
}

# Options may stand among the files: these go round to the end of the list.
left=$#
while [ "$left" -gt 0 ]; do
    taken=1
    case $1 in
    --)
        shift
        while [ $((left -= 1)) -gt 0 ]; do
            set -- "$@" "$1"
            shift
        done
        break
        ;;
    -?*) if [ "$left" -gt 1 ]; then read_option "$1" "$2"; else read_option "$1"; fi ;;
    *) set -- "$@" "$1" ;;
    esac
    shift "$taken"
    left=$((left - taken))
done
[ $# -gt 0 ] || set -- -

case $log in
'' | x | y | xy | none) ;;
*) misuse "--log takes x, y, xy or none, not \"$log\"" ;;
esac
case $output in
'') form=dumb ;;
*.svg) form=svg ;;
*.png) form=png ;;
*) misuse "--output takes a FILE.svg or FILE.png, not \"$output\"" ;;
esac
command -v gnuplot >/dev/null 2>&1 ||
    fail "gnuplot, which draws the pictures, is not installed"
for file; do
    if [ "$file" = - ]; then
        true 2>/dev/null 3<&0 || fail "standard input: cannot read"
        [ ! -d /dev/stdin ] || fail "standard input: Is a directory"
        continue
    fi
    [ -e "$file" ] || fail "$file: No such file or directory"
    [ ! -d "$file" ] || fail "$file: Is a directory"
done

[ -n "$output" ] || true 2>/dev/null 3>&1 || fail "standard output: cannot write"

# ---- Tables to a gnuplot script, and that to a picture ------------------------------

# The program opens the FILEs itself, so that none is taken for an assignment.
script=$(KOKSMA_X=$column_x KOKSMA_Y=$column_y KOKSMA_LOG=$log KOKSMA_TITLE=$title \
    KOKSMA_FORM=$form awk '
@PROGRAM@
' "$@") || exit 1

# gnuplot does not notice a full disk, but cat does.  Warnings of gnuplot's, say of a
# range that is a single number, are nothing to the one who asked for a picture; and
# 141, that the reader has left (SIGPIPE), is no failure.
draw() {
    {
        { printf '%s\n' "$script" | gnuplot -d 2>&3 || [ $? -eq 141 ] || echo failed >&3; } |
            cat 2>/dev/null >&4 || [ $? -eq 141 ] || echo "cannot write" >&3
    } 3>&1
}

if [ -n "$output" ]; then
    (: >>"$output") 2>/dev/null || fail "$output: cannot write"
    { message=$(draw); } 4>"$output"
else
    { message=$(draw); } 4>&1
fi
case $message in
*failed | *"cannot write")
    [ -f "$output" ] && rm -f "$output"
    case $message in
    *failed) fail "gnuplot failed: $(printf '%s\n' "$message" | sed -n '/[^ ]/{p;q;}')" ;;
    *) fail "${output:-standard output}: cannot write" ;;
    esac
    ;;
esac
