#!/bin/sh
# The error of f3 = a (x+y+z) + (0.6-1.8a) [x+y+z > 1] for jumps of all sizes: the
# paper's figure 6, drawn as figure5.sh draws its figure 5.
. "$(dirname "$0")/common.sh"
n=2^20 replicates=64 path=2^22 # the largest error is over all the path

for a in 0 0.2 0.3333333333333333; do # no jump is left at 1/3
    koksma-points halton -d 3 -n $n --scramble digits --replicates $replicates --npy |
        koksma-eval f3 -a $a --npy | curve "a = ${a%33333333333333}" --exact 0.5
    koksma-points halton -d 3 -n $path --npy |
        koksma-eval f3 -a $a --npy |
        koksma-error --exact 0.5 --prefixes 1:$n >"Halton, a = ${a%33333333333333}"
done
koksma-points random -d 3 -n $n --replicates $replicates --npy |
    koksma-eval f3 --npy | curve "random points, a = 0" --exact 0.5
koksma-points random -d 3 -n $path --npy |
    koksma-eval f3 --npy | koksma-error --exact 0.5 --prefixes 1:$n >"random, a = 0"

fit "a = 0" -d 3
fit "a = 0.2" -d 3 -m two-terms
fit "a = 0.33" --claim -1
fit "random points, a = 0" --claim -0.5

picture figure6 "f3, $replicates digit-permuted Halton sequences: theory for a jump is -(D+1)/2D = -2/3" \
    "a = 0" "a = 0.2" "a = 0.33" "random points, a = 0"
picture figure6-path "f3, the Halton sequence itself from index 0: one path, so no interval" \
    "Halton, a = 0" "Halton, a = 0.2" "Halton, a = 0.33" "random, a = 0"
