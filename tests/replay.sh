#!/bin/sh
# The fuzz targets over the corpus: what once broke a reader stays mended.
set -eu
for target in points npy table grid options; do
    ${EMULATOR-} "$top_builddir/tests/replay_$target" "$top_srcdir/tests/corpus/$target"
done
