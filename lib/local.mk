# The kernels and the public functions form one archive, which the tests link
# so that they can reach ki_ names; libkoksma.la exports koksma_ names alone.
noinst_LTLIBRARIES = %D%/libcore.la
%C%_libcore_la_SOURCES = \
  %D%/bound.c %D%/bound.h \
  %D%/box.c %D%/box.h %D%/box_kernels.h %D%/box_bound.c %D%/box_kinetic.c %D%/box_line.c \
  %D%/box_strip.c %D%/box_sweep.c %D%/box_sweep_kernels.h \
  %D%/cells.c %D%/cells.h %D%/cells_kernels.h %D%/cells_grid.c %D%/cells_line.c \
  %D%/cells_lines.c %D%/cells_occupancy.c %D%/cells_samples.c %D%/cells_slope.c \
  %D%/curve.c %D%/curve.h \
  %D%/edge.c %D%/edge.h %D%/edge_kernels.h %D%/edge_about.c %D%/edge_cell.c %D%/edge_leaf.c \
  %D%/edge_line.c %D%/edge_run.c %D%/edge_sort.c %D%/edge_sweep.c %D%/edge_tree.c \
  %D%/error.c %D%/error.h \
  %D%/fit.c %D%/fit.h %D%/fit_kernels.h %D%/fit_grid.c %D%/fit_judge.c \
  %D%/fit_line.c %D%/fit_mixture.c \
  %D%/gen.c %D%/gen.h %D%/gen_kernels.h %D%/gen_binary.c %D%/gen_check.c \
  %D%/gen_digits.c %D%/gen_faure.c %D%/gen_fixed.c %D%/gen_fold.c \
  %D%/gen_fractions.c %D%/gen_halton.c %D%/gen_kronecker.c %D%/gen_lattice.c \
  %D%/gen_niederreiter.c %D%/gen_owen.c %D%/gen_plain.c %D%/gen_poisson.c \
  %D%/gen_primes.c %D%/gen_radical.c %D%/gen_sobol.c %D%/gen_strata.c \
  %D%/gen_zaremba.c \
  %D%/integrand.c %D%/integrand.h %D%/integrand_kernels.h \
  %D%/integrand_ball.c %D%/integrand_box.c %D%/integrand_fractal.c \
  %D%/integrand_koch.c %D%/integrand_product.c %D%/integrand_spline.c \
  %D%/integrand_split.c \
  %D%/integrand_sum.c %D%/integrand_wave.c \
  %D%/io.c %D%/io.h %D%/io_kernels.h %D%/io_about.c %D%/io_lines.c %D%/io_npy.c \
  %D%/io_number.c %D%/io_table.c %D%/io_text.c %D%/io_write.c \
  %D%/l2.c %D%/l2.h %D%/l2_kernels.h %D%/l2_cut.c %D%/l2_divide.c \
  %D%/l2_divide_kernels.h %D%/l2_items.c %D%/l2_kinds.c %D%/l2_linear.c \
  %D%/l2_sweep.c %D%/l2_number.c %D%/l2_pairs.c %D%/l2_sort.c %D%/l2_terms.c %D%/l2_tile.c \
  %D%/num.c %D%/num.h %D%/num_kernels.h %D%/num_student.c %D%/num_twice.h \
  %D%/num_exact.c %D%/num_exact.h %D%/num_wide.h \
  %D%/part.c %D%/part.h \
  %D%/points.c %D%/points.h \
  %D%/rng.c %D%/rng.h %D%/rng_kernels.h \
  %D%/scene.c %D%/scene.h %D%/scene_kernels.h \
  %D%/star.c %D%/star.h %D%/star_kernels.h %D%/star_bound.c %D%/star_dem.c \
  %D%/star_dem_cell.c %D%/star_dem_kernels.h \
  %D%/star_lines.c %D%/star_lines_cell.c %D%/star_lines_climb.c \
  %D%/star_lines_finds.c %D%/star_lines_flow.c %D%/star_lines_grid.c %D%/star_lines_kernels.h \
  %D%/star_lines_leaf.c %D%/star_lines_tasks.c %D%/star_lines_thin.c \
  %D%/star_sweep.c %D%/star_tree.c \
  %D%/tree.c %D%/tree_kernels.h %D%/tree_best.c %D%/tree_best_kernels.h \
  %D%/tree_bound.c %D%/tree_bound_closed.c %D%/tree_bound_open.c %D%/tree_cell.c \
  %D%/tree_climb.c %D%/tree_climb_kernels.h %D%/tree_dive.c %D%/tree_ranks.c \
  %D%/tree_run.c %D%/tree_run_kernels.h %D%/tree_search.c %D%/tree_sort.c \
  %D%/variation.c %D%/variation.h %D%/variation_kernels.h %D%/variation_cell.c \
  %D%/variation_dense.c %D%/variation_grid.c %D%/variation_points.c \
  %D%/variation_random.c %D%/variation_tree.c
%C%_libcore_la_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_builddir)/%D%

# Sobol's direction numbers, from the published table to C.
BUILT_SOURCES += %D%/joe_kuo.inc
CLEANFILES    += %D%/joe_kuo.inc
%D%/joe_kuo.inc: $(top_srcdir)/data/joe_kuo_1111.txt
	$(AM_V_GEN)$(MKDIR_P) %D% && $(AWK) '/^[0-9]/ { \
	  printf "{%s, %s, {%s", $$2, $$3, $$4; \
	  for (i = 5; i <= NF; i++) printf ", %s", $$i; \
	  print "}}," }' $(top_srcdir)/data/joe_kuo_1111.txt >$@.new && mv $@.new $@

lib_LTLIBRARIES = %D%/libkoksma.la
%C%_libkoksma_la_SOURCES =
%C%_libkoksma_la_LIBADD  = %D%/libcore.la
%C%_libkoksma_la_LDFLAGS = -no-undefined -version-info $(KOKSMA_LT_VERSION) \
  -export-symbols-regex '^koksma_'

include_HEADERS = %D%/koksma.h
koksmaincludedir = $(includedir)/koksma
koksmainclude_HEADERS = \
  %D%/bound.h %D%/box.h %D%/cells.h %D%/curve.h %D%/edge.h %D%/fit.h %D%/gen.h \
  %D%/integrand.h %D%/io.h %D%/l2.h %D%/num.h %D%/points.h %D%/rng.h \
  %D%/scene.h %D%/star.h %D%/variation.h

pkgconfig_DATA = %D%/koksma.pc
