# Unit tests link the convenience archive, so that they reach ki_ names too.
# TEST_EXTENSIONS lets a wrapper in LOG_COMPILER wrap programs and not scripts.
TEST_EXTENSIONS = .sh
SH_LOG_COMPILER = $(SHELL)
AM_TESTS_ENVIRONMENT = \
  top_srcdir='$(top_srcdir)'; export top_srcdir; \
  top_builddir='$(top_builddir)'; export top_builddir; \
  MANDOC='$(MANDOC)'; export MANDOC; \
  CC='$(CC)'; export CC; \
  NM='$(NM)'; export NM; \
  CK_EXCLUDE_TAGS=$${CK_EXCLUDE_TAGS-big}; export CK_EXCLUDE_TAGS; \
  PATH='$(abs_top_builddir)/bin':$$PATH; export PATH;

structure_scripts = \
  %D%/cli.sh %D%/floors.sh %D%/headers.sh %D%/man.sh %D%/names.sh %D%/symbols.sh
TESTS      += $(structure_scripts)
EXTRA_DIST += $(structure_scripts)

if HAVE_CHECK
check_LTLIBRARIES += %D%/liboracle.la
%C%_liboracle_la_SOURCES = %D%/oracle.c %D%/oracle.h
%C%_liboracle_la_CFLAGS  = $(AM_CFLAGS) $(CHECK_CFLAGS)

unit_tests = %D%/test_points %D%/test_star
check_PROGRAMS += $(unit_tests)
TESTS          += $(unit_tests)

unit_cflags = $(AM_CFLAGS) $(CHECK_CFLAGS)
unit_libs   = %D%/liboracle.la lib/libcore.la $(CHECK_LIBS)

%C%_test_points_SOURCES = %D%/test_points.c
%C%_test_points_CFLAGS  = $(unit_cflags)
%C%_test_points_LDADD   = $(unit_libs)
%C%_test_star_SOURCES   = %D%/test_star.c
%C%_test_star_CFLAGS    = $(unit_cflags)
%C%_test_star_LDADD     = $(unit_libs)
endif
