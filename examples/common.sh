# What the examples share; each sources it first.  An example writes its pictures,
# NAME.svg and NAME.png, into the folder that it is given, figures/ if none; all else
# is in a scratch folder that goes away.
# shellcheck shell=sh
set -eu
if ! command -v gnuplot >/dev/null 2>&1; then
    echo "No figures: gnuplot, which draws them, is not installed."
    exit 0
fi
mkdir -p "${1:-figures}"
figures=$(cd "${1:-figures}" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# curve NAME OPTION...: of the values on standard input, which are read once, the error
# of each replicate, NAME.errors, and their root mean square with its interval, NAME.
# The values come as .npy, ten times as fast as text but without comments, so that the
# options have to say the exact integral.
curve() {
    curve=$1
    shift
    mkfifo values
    koksma-error --summary "$@" values >"$curve" &
    tee values | koksma-error "$@" >"$curve.errors"
    wait "$!"
    rm values
}

# walks NAME INTEGRAND DIM ALBEDO POINTS...: the curve of the sphere's INTEGRAND with so
# many coordinates, for $replicates sets of $n of the points that the words make.
# shellcheck disable=SC2154 # the examples set both
walks() {
    walks=$1 integrand=$2 dim=$3 albedo=$4
    shift 4
    koksma-points "$@" -d "$dim" -n "$n" --replicates "$replicates" --npy |
        koksma-eval "$integrand" --albedo "$albedo" --npy |
        curve "$walks" --exact \
            "$(koksma-eval --list "$integrand" -d "$dim" -a albedo="$albedo" -q | cut -f 4)"
}

# fit NAME OPTION...: the exponent of a curve and the verdict on it, which are printed:
# the model, the exponent and its interval, the claim, the verdict and the doubt.
fit() {
    fit=$1
    shift
    koksma-fit "$@" "$fit.errors" >"$fit.fit"
    printf '%s\t' "$fit"
    tail -n 1 "$fit.fit" | cut -f 1-4,6-8
}

# picture NAME TITLE CURVE...: the curves, each with its fit if it has one.
picture() {
    picture=$1 title=$2
    shift 2
    for curve; do
        [ ! -e "$curve.fit" ] || set -- "$@" "$curve.fit"
    done
    for form in svg png; do
        koksma-plot --title "$title" -o "$figures/$picture.$form" "$@"
    done
    echo "$figures/$picture.svg and .png"
}
