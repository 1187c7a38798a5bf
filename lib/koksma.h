#ifndef KOKSMA_H
#define KOKSMA_H

/* libkoksma: discrepancy and variation analysis.  koksma(3) is the map. */

#include <koksma/bound.h>
#include <koksma/box.h>
#include <koksma/cells.h>
#include <koksma/curve.h>
#include <koksma/edge.h>
#include <koksma/fit.h>
#include <koksma/gen.h>
#include <koksma/integrand.h>
#include <koksma/io.h>
#include <koksma/l2.h>
#include <koksma/num.h>
#include <koksma/points.h>
#include <koksma/rng.h>
#include <koksma/scene.h>
#include <koksma/star.h>
#include <koksma/variation.h>

#endif
