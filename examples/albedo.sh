#!/bin/sh
# Single bounces beside the sum of all of them, for surfaces that reflect 0.2, 0.5 and
# 0.8 of the light: which bounce makes the error?  A picture for each albedo.
. "$(dirname "$0")/common.sh"
n=2^15 replicates=64

for albedo in 0.2 0.5 0.8; do
    for bounce in 1 2 3 4; do
        walks "bounce $bounce" sphere $((2 * bounce)) "$albedo" halton --scramble digits
        fit "bounce $bounce" -d $((2 * bounce))
    done
    walks "sum of 1 to 4" sphere-sum 8 "$albedo" halton --scramble digits
    fit "sum of 1 to 4" # a sum of powers, for which there is no claim
    walks "random points, sum of 1 to 4" sphere-sum 8 "$albedo" random
    fit "random points, sum of 1 to 4" --claim -0.5
    picture "albedo-$albedo" "Gathering in a sphere of albedo $albedo, $replicates replicates" \
        "bounce 1" "bounce 2" "bounce 3" "bounce 4" "sum of 1 to 4" \
        "random points, sum of 1 to 4"
done
