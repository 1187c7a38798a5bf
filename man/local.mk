# One page a tool, the formats, the library, and the words behind them all.
dist_man_MANS += \
  %D%/koksma-bound.1 %D%/koksma-box.1 %D%/koksma-cells.1 %D%/koksma-edge.1 %D%/koksma-error.1 \
  %D%/koksma-eval.1 %D%/koksma-fit.1 %D%/koksma-l2.1 %D%/koksma-plot.1 \
  %D%/koksma-points.1 \
  %D%/koksma-star.1 \
  %D%/koksma-trade.7 \
  %D%/koksma-variation.1 \
  %D%/koksma.3 \
  %D%/koksma_points.5 %D%/koksma_values.5 \
  %D%/koksma.7
