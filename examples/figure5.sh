#!/bin/sh
# The error of f2 = a (x+y) + (1-2a) [x+y > 1] for jumps of all sizes: the paper's
# figure 5.  Once as root mean square over replicates, of which a slope can be
# believed; once as the paper draws it, the largest error of one path from N on.
. "$(dirname "$0")/common.sh"
n=2^20 replicates=64 path=2^22 # the largest error is over all the path

for a in 0 0.2 0.4 0.45 0.5; do
    koksma-points halton -n $n --scramble digits --replicates $replicates --npy |
        koksma-eval f2 -a $a --npy | curve "a = $a" --exact 0.5
    koksma-points halton -n $path --npy |
        koksma-eval f2 -a $a --npy | koksma-error --exact 0.5 --prefixes 1:$n >"Halton, a = $a"
done
koksma-points random -n $n --replicates $replicates --npy |
    koksma-eval f2 --npy | curve "random points, a = 0" --exact 0.5
koksma-points random -n $path --npy |
    koksma-eval f2 --npy | koksma-error --exact 0.5 --prefixes 1:$n >"random, a = 0"

# A pure jump, jumps beside a smooth part, no jump, and no low discrepancy.
fit "a = 0" -d 2
for a in 0.2 0.4 0.45; do fit "a = $a" -d 2 -m two-terms; done
fit "a = 0.5" --claim -1
fit "random points, a = 0" --claim -0.5

picture figure5 "f2, $replicates digit-permuted Halton sequences: theory for a jump is -(D+1)/2D = -3/4" \
    "a = 0" "a = 0.2" "a = 0.4" "a = 0.45" "a = 0.5" "random points, a = 0"
picture figure5-path "f2, the Halton sequence itself from index 0: one path, so no interval" \
    "Halton, a = 0" "Halton, a = 0.2" "Halton, a = 0.4" "Halton, a = 0.45" \
    "Halton, a = 0.5" "random, a = 0"
