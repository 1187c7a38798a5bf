#!/bin/sh
# The radiance after n = 1, 2, 5 and 10 bounces inside of a diffuse sphere, by gathering
# walks of quasi-random and of random steps: the paper's figure 8.  A bounce takes two
# coordinates, D = 2n.
. "$(dirname "$0")/common.sh"
n=2^17

replicates=128
walks "Halton, n = 1" sphere 2 0.5 halton --scramble digits
walks "Halton, n = 2" sphere 4 0.5 halton --scramble digits
fit "Halton, n = 1" -d 2
fit "Halton, n = 2" -d 4 --from 210 # the product of the bases

# For n = 5 and 10 the product of the bases is 6e9 and 6e26.  The windows that one can
# afford end before the theory begins, and test nothing.
replicates=32
walks "Halton, n = 5, N too small" sphere 10 0.5 halton --scramble digits
walks "Halton, n = 10, N too small" sphere 20 0.5 halton --scramble digits
fit "Halton, n = 5, N too small" -d 10
fit "Halton, n = 10, N too small" -d 20

for bounces in 1 2 5 10; do
    walks "random, n = $bounces" sphere $((2 * bounces)) 0.5 random
    fit "random, n = $bounces" --claim -0.5
done

picture figure8 "Light after n bounces in a sphere: theory for large N is -(2n+1)/4n" \
    "Halton, n = 1" "random, n = 1" "Halton, n = 2" "random, n = 2" \
    "Halton, n = 5, N too small" "random, n = 5" "Halton, n = 10, N too small" "random, n = 10"
