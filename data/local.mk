# joe_kuo_1111.txt holds the licence of numbers that are compiled into the library.
dist_pkgdata_DATA = %D%/bundschuh_zhu_32.txt %D%/joe_kuo_1111.txt
EXTRA_DIST += %D%/README %D%/known_star.tsv
