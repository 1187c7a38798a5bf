#!/bin/sh
# Gathering from the eye beside shooting from the light, each summing bounces 1 to 4: a
# shooting walk needs two coordinates more, for its point on the light.  The light and
# the patch that shooting has to hit are of one size, so that the answer and the
# variance of a single bounce are the same for both.
. "$(dirname "$0")/common.sh"
n=2^15 replicates=64

set --
for albedo in 0.2 0.5 0.8; do
    walks "gathering, albedo $albedo" sphere-sum 8 "$albedo" halton --scramble digits
    walks "shooting, albedo $albedo" sphere-shoot-sum 10 "$albedo" halton --scramble digits
    set -- "$@" "gathering, albedo $albedo" "shooting, albedo $albedo"
done
for name; do fit "$name"; done
picture shooting "Four bounces in a sphere, $replicates replicates" "$@"
