dist_pkgdata_DATA = %D%/bundschuh_zhu_32.txt
EXTRA_DIST += %D%/README %D%/joe_kuo_50.txt %D%/known_star.tsv
