# The tools are installed as koksma-<tool>, one file each over cli.
noinst_LTLIBRARIES += %D%/libcli.la
%C%_libcli_la_SOURCES = %D%/cli.h %D%/cli.c %D%/cli_input.c %D%/cli_prefixes.c \
  %D%/cli_search.h %D%/cli_search.c %D%/cli_watch.c %D%/cli_integrand.h \
  %D%/cli_integrand.c
tool_libs = %D%/libcli.la lib/libkoksma.la

bin_PROGRAMS += \
  %D%/koksma-bound %D%/koksma-box %D%/koksma-cells %D%/koksma-edge %D%/koksma-error \
  %D%/koksma-eval %D%/koksma-fit %D%/koksma-l2 %D%/koksma-points %D%/koksma-star \
  %D%/koksma-variation
%C%_koksma_bound_SOURCES  = %D%/bound.c %D%/bound_input.h %D%/bound_input.c \
  %D%/bound_report.h %D%/bound_report.c
%C%_koksma_box_SOURCES    = %D%/box.c
%C%_koksma_cells_SOURCES  = %D%/cells.c %D%/cells_report.h %D%/cells_sets.c \
  %D%/cells_table.c
%C%_koksma_edge_SOURCES   = %D%/edge.c
%C%_koksma_error_SOURCES  = %D%/error.c %D%/error_report.h %D%/error_report.c
%C%_koksma_eval_SOURCES   = %D%/eval.c
%C%_koksma_fit_SOURCES    = %D%/fit.c %D%/fit_report.h %D%/fit_report.c
%C%_koksma_l2_SOURCES     = %D%/l2.c
%C%_koksma_points_SOURCES = %D%/points.c
%C%_koksma_star_SOURCES   = %D%/star.c
%C%_koksma_variation_SOURCES = %D%/variation.c %D%/variation_report.h \
  %D%/variation_report.c %D%/variation_run.h %D%/variation_run.c
%C%_koksma_bound_LDADD  = $(tool_libs)
%C%_koksma_box_LDADD    = $(tool_libs)
%C%_koksma_cells_LDADD  = $(tool_libs)
%C%_koksma_edge_LDADD   = $(tool_libs)
%C%_koksma_error_LDADD  = $(tool_libs)
%C%_koksma_eval_LDADD   = $(tool_libs)
%C%_koksma_fit_LDADD    = $(tool_libs)
%C%_koksma_l2_LDADD     = $(tool_libs)
%C%_koksma_points_LDADD = $(tool_libs)
%C%_koksma_star_LDADD   = $(tool_libs)
%C%_koksma_variation_LDADD = $(tool_libs)

# koksma-plot is a shell script that carries its awk programs, one file to install.
bin_SCRIPTS = %D%/koksma-plot
plot_parts  = %D%/plot_write.awk %D%/plot_read.awk
EXTRA_DIST += %D%/plot.sh $(plot_parts)
CLEANFILES += %D%/koksma-plot
%D%/koksma-plot: %D%/plot.sh $(plot_parts) Makefile
	$(AM_V_GEN)$(MKDIR_P) %D% && rm -f $@ && \
	(cd $(srcdir) && $(SED) -e 's/@PLOT_VERSION@/$(VERSION)/' \
	  -e '/^@PROGRAM@$$/!b' -e 'r bin/plot_write.awk' -e 'r bin/plot_read.awk' -e d \
	  bin/plot.sh) >$@.tmp && chmod +x $@.tmp && mv $@.tmp $@
