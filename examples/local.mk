# The pictures of the paper.  An example is a pipeline of the tools, which are those of
# this build; "make figures" runs them all.
examplesdir = $(docdir)/examples
dist_examples_SCRIPTS = \
  %D%/figure2.sh %D%/figure5.sh %D%/figure6.sh %D%/figure8.sh %D%/albedo.sh \
  %D%/halton-bases.sh %D%/patterns.sh %D%/shooting.sh
dist_examples_DATA = %D%/README %D%/common.sh

.PHONY: figures
figures: all
	@command -v gnuplot >/dev/null 2>&1 || \
	  { echo "No figures: gnuplot, which draws them, is not installed."; exit 0; }; \
	for example in $(dist_examples_SCRIPTS); do \
	  PATH='$(abs_top_builddir)/bin':$$PATH $(SHELL) $(srcdir)/$$example figures || exit 1; \
	done

clean-local: clean-figures
.PHONY: clean-figures
clean-figures:
	rm -rf figures
