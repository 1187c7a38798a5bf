#!/bin/sh
# Supersampling patterns by what they are good at: the star, box, edge (half-plane) and
# L2 discrepancy of the patterns of computer graphics beside those of number theory,
# after D. Dobkin, D. Eppstein and D. Mitchell (1996).  What is random is measured 20
# times.  Writes patterns.tsv besides, where the best comes first.
. "$(dirname "$0")/common.sh"
replicates=20
t=2.093 # Student's, 97.5 %, 19 degrees of freedom: NIST/SEMATECH e-Handbook, 1.3.6.7.2

# measure NAME WORD...: the sets that the words make, by every discrepancy.
measure() {
    name=$1
    shift
    for n in 16 64 256 1024; do
        koksma-points "$@" -n $n -q
        echo
    done >points
    for kind in star box edge l2; do
        mkdir -p $kind
        koksma-$kind points >measured
        average $kind "$name" <measured
    done
}

# average KIND NAME: the discrepancy of each set in KIND/NAME.errors, for fit; in
# KIND/NAME their mean at each n, with its 95 % interval, nan where there is one set.
average() {
    awk -v OFS='\t' 'BEGIN { print "# set", "n", "upper" }
        !/^#/ { print ++sets[$2], $2, $5 }' >"$1/$2.errors"
    awk -v t=$t -v OFS='\t' 'BEGIN { print "# n", "mean", "lower", "upper", "sets" }
        !/^#/ { value[$2, ++sets[$2]] = $3; sum[$2] += $3 }
        END { for (n = 16; n in sets; n *= 4) {
            k = sets[n]; mean = sum[n] / k; squares = 0; lower = upper = "nan"
            for (i = 1; i <= k; i++) squares += (value[n, i] - mean) ^ 2
            if (k > 1) {
                half = t * sqrt(squares / (k - 1) / k)
                lower = sprintf("%.6f", mean - half); upper = sprintf("%.6f", mean + half)
            }
            print n, sprintf("%.6f", mean), lower, upper, k
        } }' "$1/$2.errors" >"$1/$2"
}

set -- random jittered Poisson N-rooks Halton Hammersley Zaremba "Sobol'"
measure random random --replicates $replicates
measure jittered jittered --replicates $replicates
measure Poisson poisson --replicates $replicates
measure N-rooks latin --replicates $replicates
measure Halton halton
measure Hammersley hammersley
measure Zaremba zaremba
measure "Sobol'" sobol

tab=$(printf '\t')
{
    printf '# kind\tn\tpattern\tmean\tlower\tupper\tsets\n'
    for kind in star box edge l2; do
        for name; do
            sed "/^#/d; s/^[0-9]*/$kind$tab&$tab$name/" "$kind/$name"
        done | sort -t "$tab" -k 2,2n -k 4,4n
    done
} >"$figures/patterns.tsv"
echo "$figures/patterns.tsv"

# The slopes come after the pictures, which would draw them over the curves.
for kind in star box edge l2; do
    cd $kind
    picture patterns-$kind "Discrepancy of koksma-$kind: one set, or the mean of $replicates random ones and its interval" \
        -y mean "$@"
    for name in random jittered Poisson N-rooks; do fit "$name"; done
    cd ..
done
