#!/bin/sh
# Halton's large bases: the star discrepancy of the first N points in pairs of
# neighbouring primes, and the error that they make for f2, a = 0, beside random points.
. "$(dirname "$0")/common.sh"
n=2^17 path=2^19 # the largest error from N on is over all the path
mkdir error

measure() { # NAME WORD...: both, and the slope, of the points that the words make
    name=$1
    shift
    koksma-points "$@" -n $n >points
    koksma-star --prefixes 2^4:$n points >"$name"
    koksma-fit --from 1024 "$name" >"$name.fit"
    koksma-points "$@" -n $path --npy | koksma-eval f2 --npy |
        koksma-error --exact 0.5 --prefixes 1:$n >"error/$name"
}

for bases in 2,3 11,13 23,29 41,43 67,71; do
    measure "bases $bases" halton --bases $bases
done
measure "bases 67,71, digits permuted" halton --bases 67,71 --scramble digits
measure "random points" random

set -- "bases 2,3" "bases 11,13" "bases 23,29" "bases 41,43" "bases 67,71" \
    "bases 67,71, digits permuted" "random points"
picture halton-bases "Star discrepancy of the first N points, and its slope from N = 1024 on" "$@"
cd error
picture halton-bases-error "Error of f2, a = 0, one path each" "$@"
