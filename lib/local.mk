# The kernels and the public functions form one archive, which the tests link
# so that they can reach ki_ names; libkoksma.la exports koksma_ names alone.
noinst_LTLIBRARIES = %D%/libcore.la
%C%_libcore_la_SOURCES = \
  %D%/box.c %D%/box.h %D%/box_kernels.h %D%/box_bound.c %D%/box_kinetic.c \
  %D%/box_strip.c %D%/box_sweep.c %D%/box_sweep_kernels.h \
  %D%/curve.c %D%/curve.h \
  %D%/error.c %D%/error.h \
  %D%/fit.c %D%/fit.h %D%/fit_kernels.h %D%/fit_grid.c %D%/fit_judge.c \
  %D%/fit_line.c %D%/fit_mixture.c \
  %D%/gen.c %D%/gen.h %D%/gen_kernels.h %D%/gen_halton.c %D%/gen_plain.c \
  %D%/gen_radical.c %D%/gen_sobol.c \
  %D%/integrand.c %D%/integrand.h %D%/integrand_kernels.h \
  %D%/integrand_ball.c %D%/integrand_box.c %D%/integrand_fractal.c \
  %D%/integrand_koch.c %D%/integrand_product.c %D%/integrand_spline.c \
  %D%/integrand_sum.c %D%/integrand_wave.c \
  %D%/io.c %D%/io.h %D%/io_kernels.h %D%/io_about.c %D%/io_lines.c %D%/io_npy.c \
  %D%/io_number.c %D%/io_table.c %D%/io_text.c %D%/io_write.c \
  %D%/l2.c %D%/l2.h %D%/l2_kernels.h %D%/l2_cross.c %D%/l2_divide.c \
  %D%/l2_divide_kernels.h %D%/l2_kinds.c %D%/l2_linear.c %D%/l2_merge.c \
  %D%/l2_number.c %D%/l2_pairs.c %D%/l2_sort.c %D%/l2_tile.c \
  %D%/num.c %D%/num.h %D%/num_kernels.h %D%/num_student.c %D%/num_twice.h \
  %D%/part.c %D%/part.h \
  %D%/points.c %D%/points.h \
  %D%/rng.c %D%/rng.h \
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
  %D%/tree_run.c %D%/tree_run_kernels.h %D%/tree_search.c %D%/tree_sort.c
%C%_libcore_la_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_builddir)/%D%

# Sobol's direction numbers, from the published table to C.
BUILT_SOURCES += %D%/joe_kuo.inc
CLEANFILES    += %D%/joe_kuo.inc
%D%/joe_kuo.inc: $(top_srcdir)/data/joe_kuo_50.txt
	$(AM_V_GEN)$(MKDIR_P) %D% && $(AWK) '/^[0-9]/ { \
	  printf "{%s, %s, {%s", $$2, $$3, $$4; \
	  for (i = 5; i <= NF; i++) printf ", %s", $$i; \
	  print "}}," }' $(top_srcdir)/data/joe_kuo_50.txt >$@.new && mv $@.new $@

lib_LTLIBRARIES = %D%/libkoksma.la
%C%_libkoksma_la_SOURCES =
%C%_libkoksma_la_LIBADD  = %D%/libcore.la
%C%_libkoksma_la_LDFLAGS = -no-undefined -version-info $(KOKSMA_LT_VERSION) \
  -export-symbols-regex '^koksma_'

include_HEADERS = %D%/koksma.h
koksmaincludedir = $(includedir)/koksma
koksmainclude_HEADERS = \
  %D%/box.h %D%/curve.h %D%/fit.h %D%/gen.h %D%/integrand.h %D%/io.h %D%/l2.h %D%/num.h \
  %D%/points.h %D%/rng.h %D%/scene.h %D%/star.h

pkgconfig_DATA = %D%/koksma.pc
