# Unit tests link the convenience archive, so that they reach ki_ names too.
# TEST_EXTENSIONS lets a wrapper in LOG_COMPILER wrap programs and not scripts.
# A case that hangs is ended after two minutes: Check's own four seconds are too few
# for sanitizers on a busy machine.
TEST_EXTENSIONS = .sh
SH_LOG_COMPILER = $(SHELL)
AM_TESTS_ENVIRONMENT = \
  top_srcdir='$(top_srcdir)'; export top_srcdir; \
  top_builddir='$(top_builddir)'; export top_builddir; \
  MANDOC='$(MANDOC)'; export MANDOC; \
  CC='$(CC)'; export CC; \
  NM='$(NM)'; export NM; \
  CK_EXCLUDE_TAGS=$${CK_EXCLUDE_TAGS-big}; export CK_EXCLUDE_TAGS; \
  CK_DEFAULT_TIMEOUT=$${CK_DEFAULT_TIMEOUT-120}; export CK_DEFAULT_TIMEOUT; \
  PATH='$(abs_top_builddir)/bin':$$PATH; export PATH;

structure_scripts = \
  %D%/cli.sh %D%/cli_big.sh %D%/cli_bound.sh %D%/cli_box.sh %D%/cli_cells.sh \
  %D%/cli_edge.sh %D%/cli_faults.sh %D%/cli_peers.sh %D%/cli_plot.sh \
  %D%/cli_star.sh %D%/cli_variation.sh %D%/floors.sh %D%/headers.sh %D%/man.sh \
  %D%/names.sh %D%/symbols.sh
TESTS      += $(structure_scripts) %D%/replay.sh
EXTRA_DIST += $(structure_scripts) %D%/cli_rows.sh %D%/replay.sh %D%/corpus

# ---- Unit tests: one Check program a module ------------------------------------

if HAVE_CHECK
check_LTLIBRARIES += %D%/liboracle.la
%C%_liboracle_la_SOURCES = \
  %D%/alloc_fixture.h %D%/certify_fixture.h %D%/edge_fixture.h %D%/exact.c \
  %D%/exact.h %D%/exact_l2.c %D%/exact_oracle.c %D%/exact_oracle.h \
  %D%/extremes_fixture.h %D%/fit_fixture.h %D%/gen_fixture.h \
  %D%/integrand_fixture.h %D%/io_fixture.h %D%/npy_fixture.h %D%/oracle.c \
  %D%/oracle.h %D%/oracle_wide.c %D%/paths.h

unit_tests = \
  %D%/test_bound %D%/test_box %D%/test_box_bound %D%/test_cells \
  %D%/test_cells_lines %D%/test_certify %D%/test_curve %D%/test_edge \
  %D%/test_edge_cell %D%/test_extra %D%/test_extremes %D%/test_extremes_gen \
  %D%/test_extremes_sets %D%/test_extremes_values %D%/test_facts %D%/test_fit \
  %D%/test_fit_coverage %D%/test_fit_judge %D%/test_fit_mixture %D%/test_fit_rules \
  %D%/test_fractals %D%/test_gen %D%/test_gen_digits %D%/test_gen_lattice \
  %D%/test_gen_nets %D%/test_gen_patterns %D%/test_gen_scramble %D%/test_integrand \
  %D%/test_io %D%/test_io_npy %D%/test_io_npy_bad %D%/test_io_number \
  %D%/test_io_reader %D%/test_io_table %D%/test_io_write %D%/test_known %D%/test_l2 \
  %D%/test_num %D%/test_part %D%/test_points %D%/test_rng %D%/test_scene \
  %D%/test_shapes %D%/test_split %D%/test_star %D%/test_star_bound \
  %D%/test_star_lines %D%/test_star_methods %D%/test_star_search \
  %D%/test_star_threads %D%/test_threads %D%/test_variation %D%/test_widths
LDADD = %D%/liboracle.la lib/libcore.la $(CHECK_LIBS)


if HAVE_COOKIES
unit_tests += %D%/test_io_faults
endif

if CAN_WRAP
unit_tests += %D%/test_alloc %D%/test_alloc_data
wrap_alloc = -Wl,--wrap=malloc -Wl,--wrap=calloc -Wl,--wrap=realloc \
  -Wl,--wrap=strndup -Wl,--wrap=getline
%C%_test_alloc_LDFLAGS      = $(wrap_alloc) -Wl,--wrap=pthread_create
%C%_test_alloc_data_LDFLAGS = $(wrap_alloc)
endif

check_PROGRAMS += $(unit_tests)
TESTS          += $(unit_tests)
AM_CPPFLAGS    += $(CHECK_CFLAGS)
endif

.PHONY: check-big check-valgrind check-sanitize check-threads
# The cases tagged big, and twenty times the random sets.
check-big:
	CK_EXCLUDE_TAGS=none KOKSMA_TEST_SCALE=$${KOKSMA_TEST_SCALE-20} $(MAKE) check

# CK_FORK=no, and libtool's execute mode: valgrind is to see the test and not the
# shell script that libtool puts in front of it.  Cases tagged slow are left out, and
# those of many threads, which it runs one at a time.  Two programs run side by side.
check-valgrind: $(check_PROGRAMS)
	printf '%s\n' $(unit_tests) | CK_FORK=no CK_EXCLUDE_TAGS='big slow threads' \
	  top_srcdir='$(top_srcdir)' KOKSMA_EXTRA_SETS= xargs -P 2 -I TEST sh -c \
	    '$(LIBTOOL) --mode=execute $(VALGRIND) -q --error-exitcode=9 \
	      --leak-check=full ./TEST || [ $$? -eq 77 ]'

# A build of its own, in sanitize/, with its own flags.
SANITIZE = -g -O1 -fno-omit-frame-pointer -fsanitize=address,undefined \
  -fno-sanitize-recover=all
check-sanitize:
	$(MKDIR_P) sanitize
	cd sanitize && { test -f Makefile || \
	  $(abs_top_srcdir)/configure --disable-shared CC='$(CC)' CFLAGS='$(SANITIZE)'; } && \
	  CK_TIMEOUT_MULTIPLIER=10 $(MAKE) check

# And another, in threads/: what runs in several threads at once, and nothing else,
# since the thread sanitizer makes everything ten times as slow.  Cases tagged slow
# are left out here too.
THREAD_TESTS = %D%/test_edge %D%/test_part %D%/test_star_threads %D%/test_threads
check-threads:
	$(MKDIR_P) threads
	cd threads && { test -f Makefile || \
	  $(abs_top_srcdir)/configure --disable-shared CC='$(CC)' \
	    CFLAGS='-g -O1 -fsanitize=thread'; } && \
	  $(MAKE) all && $(MAKE) $(THREAD_TESTS) && \
	  for test in $(THREAD_TESTS); do \
	    CK_FORK=no CK_EXCLUDE_TAGS='big slow' ./$$test || exit 1; \
	  done && \
	  bin/koksma-points halton -d 4 -n 500 >points.txt && \
	  bin/koksma-star -j 4 --trace points.txt && bin/koksma-star -j 4 points.txt

# Other compilers, C libraries and machines, in ports/.
.PHONY: check-ports
EXTRA_DIST += %D%/ports.sh
check-ports:
	bash $(top_srcdir)/tests/ports.sh -o ports

# Which lines of lib/ make check runs, in a build of its own, in coverage/.
.PHONY: coverage
EXTRA_DIST += %D%/coverage.sh
COVERAGE_LEAST = 98
coverage:
	$(MKDIR_P) coverage
	cd coverage && { test -f Makefile || \
	  $(abs_top_srcdir)/configure --disable-shared CC='$(CC)' \
	    CFLAGS='-O0 --coverage' koksma_cv_clones=no; } && \
	  find . -name '*.gcda' -exec rm -f {} + && \
	  CK_TIMEOUT_MULTIPLIER=10 $(MAKE) check && \
	  $(SHELL) $(abs_top_srcdir)/tests/coverage.sh lib $(COVERAGE_LEAST)

# ---- Fuzzing: the targets are replayed over the corpus in make check -----------

fuzz_targets    = points npy table grid options
fuzz_headers    = %D%/fuzz_npy.h %D%/fuzz_sets.h %D%/io_fixture.h
check_PROGRAMS += %D%/replay_grid %D%/replay_npy %D%/replay_options \
  %D%/replay_points %D%/replay_table
%C%_replay_grid_SOURCES    = %D%/fuzz_grid.c %D%/fuzz_main.c $(fuzz_headers)
%C%_replay_grid_LDADD      = lib/libcore.la
%C%_replay_npy_SOURCES     = %D%/fuzz_npy.c %D%/fuzz_main.c $(fuzz_headers)
%C%_replay_npy_LDADD       = lib/libcore.la
%C%_replay_options_SOURCES = %D%/fuzz_options.c %D%/fuzz_main.c
%C%_replay_options_LDADD   = lib/libcore.la
%C%_replay_points_SOURCES  = %D%/fuzz_points.c %D%/fuzz_main.c $(fuzz_headers)
%C%_replay_points_LDADD    = lib/libcore.la
%C%_replay_table_SOURCES   = %D%/fuzz_table.c %D%/fuzz_main.c
%C%_replay_table_LDADD     = lib/libcore.la

.PHONY: fuzz
FUZZ_SECONDS = 30
FUZZ = $(CC) -g -O1 -ffp-contract=off $(DEFS) $(AM_CPPFLAGS) \
  -I$(abs_top_srcdir)/lib -I$(abs_top_builddir)/lib -fsanitize=address,undefined
# Takes CC=clang, for its libFuzzer; what it finds new stays in fuzz/.  The library
# is compiled once; two targets run side by side.
fuzz: $(BUILT_SOURCES)
	$(MKDIR_P) fuzz/lib
	cd fuzz/lib && $(FUZZ) -fsanitize=fuzzer-no-link -c $(abs_top_srcdir)/lib/*.c
	printf '%s\n' $(fuzz_targets) | xargs -P 2 -I TARGET sh -c \
	  '$(MKDIR_P) fuzz/TARGET && \
	  $(FUZZ) -fsanitize=fuzzer $(top_srcdir)/tests/fuzz_TARGET.c fuzz/lib/*.o -lm \
	    -o fuzz/fuzz_TARGET && \
	  fuzz/fuzz_TARGET -max_total_time=$(FUZZ_SECONDS) -verbosity=0 \
	    -print_final_stats=1 -artifact_prefix=fuzz/TARGET- fuzz/TARGET \
	    $(top_srcdir)/tests/corpus/TARGET || exit 255'

clean-local: clean-fuzz
.PHONY: clean-fuzz
clean-fuzz:
	rm -rf coverage fuzz ports sanitize threads

# ---- Benches ---------------------------------------------------------------------

benches = \
  %D%/bench_box %D%/bench_edge \
  %D%/bench_gen %D%/bench_io %D%/bench_star %D%/bench_star_trade \
  %D%/bench_star_plane %D%/bench_l2 %D%/bench_fit %D%/bench_integrand \
  %D%/bench_cells %D%/bench_variation %D%/bench_radical
EXTRA_PROGRAMS += $(benches)
CLEANFILES     += $(benches)
%C%_bench_box_SOURCES = %D%/bench_box.c %D%/bench.h
%C%_bench_box_LDADD   = lib/libcore.la
%C%_bench_edge_SOURCES = %D%/bench_edge.c %D%/bench.h
%C%_bench_edge_LDADD   = lib/libcore.la
%C%_bench_gen_SOURCES  = %D%/bench_gen.c %D%/bench.h
%C%_bench_gen_LDADD    = lib/libcore.la -ldl
%C%_bench_io_SOURCES   = %D%/bench_io.c %D%/bench.h
%C%_bench_io_LDADD     = lib/libcore.la
%C%_bench_star_SOURCES = %D%/bench_star.c %D%/bench_star.h %D%/bench.h
%C%_bench_star_LDADD   = lib/libcore.la
%C%_bench_star_trade_SOURCES = %D%/bench_star_trade.c %D%/bench_star.h %D%/bench.h
%C%_bench_star_trade_LDADD   = lib/libcore.la
%C%_bench_star_plane_SOURCES = %D%/bench_star_plane.c %D%/bench_star.h %D%/bench.h
%C%_bench_star_plane_LDADD   = lib/libcore.la
%C%_bench_l2_SOURCES   = %D%/bench_l2.c %D%/bench.h
%C%_bench_l2_LDADD     = lib/libcore.la
%C%_bench_fit_SOURCES  = %D%/bench_fit.c %D%/bench.h %D%/paths.h
%C%_bench_fit_LDADD    = lib/libcore.la
%C%_bench_integrand_SOURCES = %D%/bench_integrand.c %D%/bench.h
%C%_bench_integrand_LDADD   = lib/libcore.la
%C%_bench_variation_SOURCES = %D%/bench_variation.c %D%/bench.h
%C%_bench_variation_LDADD   = lib/libcore.la
%C%_bench_cells_SOURCES  = %D%/bench_cells.c %D%/bench.h
%C%_bench_cells_LDADD    = lib/libcore.la

%C%_bench_radical_SOURCES = %D%/bench_radical.c %D%/bench.h
%C%_bench_radical_LDADD   = lib/libcore.la

check_PROGRAMS += %D%/bench_run
%C%_bench_run_SOURCES = %D%/bench_run.c %D%/bench.h
%C%_bench_run_LDADD   =
EXTRA_DIST += %D%/trade.sh %D%/trade_plot.sh %D%/trade_report.sh \
  %D%/peers.sh %D%/peers.py

# The tools themselves: libtool's scripts in front of them take longer to start.
bench_env = \
  BENCH_RUN='$(abs_builddir)/%D%/bench_run'; export BENCH_RUN; \
  PATH='$(abs_top_builddir)/bin/.libs:$(abs_top_builddir)/bin':$$PATH; export PATH; \
  LD_LIBRARY_PATH='$(abs_top_builddir)/lib/.libs':$$LD_LIBRARY_PATH; \
  export LD_LIBRARY_PATH;

# Each program's tables on the terminal and in bench/NAME.tsv.
.PHONY: bench trade bench-peers
bench: $(benches) trade-tables
	for bench in $(benches); do \
	  rm -f bench/done; \
	  { ./$$bench && : >bench/done; } | tee bench/$${bench#*/bench_}.tsv; \
	  rm bench/done 2>/dev/null || exit 1; \
	done

# What every knob costs and buys: tables in bench/, pictures of them in trade/.
.PHONY: trade-tables
trade-tables: all %D%/bench_run %D%/bench_radical
	$(MKDIR_P) bench
	$(bench_env) $(SHELL) $(srcdir)/%D%/trade.sh bench
	%D%/bench_radical >bench/radical.tsv
	$(SHELL) $(srcdir)/%D%/trade_report.sh bench
trade: trade-tables
	@if test '$(GNUPLOT)' = :; then \
	  echo "No pictures: gnuplot, which draws them, is not installed."; \
	else \
	  GNUPLOT='$(GNUPLOT)' $(SHELL) $(srcdir)/%D%/trade_plot.sh bench trade; \
	fi

# Other programs on the same points; and GSL's and SciPy's generators beside ours.
bench-peers: all %D%/bench_run %D%/bench_gen
	$(bench_env) BENCH_GEN='$(abs_builddir)/%D%/bench_gen' \
	  $(SHELL) $(srcdir)/%D%/peers.sh

clean-local: clean-bench
.PHONY: clean-bench
clean-bench:
	rm -rf bench trade
