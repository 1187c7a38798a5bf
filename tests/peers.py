"""peers.py PROGRAM MEASURE FILE: the measure of the points in FILE by SciPy or by
OpenTURNS, as "value seconds": the CPU seconds of the call alone, without starting
Python or reading the file.  Exit status 77: the package is not installed."""

import sys
import time


def main(program, measure, file):
    try:
        if program == "scipy":
            from scipy.stats import qmc

            def make(points):
                return lambda: qmc.discrepancy(points, method=measure)
        else:
            import openturns

            def make(points):
                sample = openturns.Sample(points)
                if measure == "star":
                    sequence = openturns.LowDiscrepancySequenceImplementation
                    return lambda: sequence.ComputeStarDiscrepancy(sample)
                return lambda: openturns.SpaceFillingC2().evaluate(sample)
    except ImportError:
        sys.exit(77)
    import numpy

    run = make(numpy.loadtxt(file, ndmin=2))
    started = time.process_time()
    value = run()
    print(repr(float(value)), time.process_time() - started)


main(*sys.argv[1:])
