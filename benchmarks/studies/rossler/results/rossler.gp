set terminal svg size 1420,836 font 'sans,12' background 'white'
set output 'rossler.svg'
set title 'Rossler, 20 candidate terms: runs with exactly the true terms (%)'
set lmargin at screen 0.274648
set rmargin at screen 1-0.070423
set bmargin at screen 0.239234
set tmargin at screen 1-0.047847
set xtics rotate by 35 right ("exact 0 %%" 0, "exact 0.1 %%" 1, "exact 1 %%" 2, "integral 0 %%" 3, "integral 0.1 %%" 4, "integral 1 %%" 5, "strong[finite-differences] 0 %%" 6, "strong[finite-differences] 0.1 %%" 7, "strong[finite-differences] 1 %%" 8, "strong[savitzky-golay] 0 %%" 9, "strong[savitzky-golay] 0.1 %%" 10, "strong[savitzky-golay] 1 %%" 11, "weak 0 %%" 12, "weak 0.1 %%" 13, "weak 1 %%" 14)
set ytics ("irls + information-criterion" 0, "irls + keep-all" 1, "irls + minor-terms" 2, "irls + sequential-thresholding" 3, "irls-l1[ceres] + information-criterion" 4, "irls-l1[ceres] + keep-all" 5, "irls-l1[ceres] + minor-terms" 6, "irls-l1[ceres] + sequential-thresholding" 7, "irls-l1[coordinate-descent] + information-criterion" 8, "irls-l1[coordinate-descent] + keep-all" 9, "irls-l1[coordinate-descent] + minor-terms" 10, "irls-l1[coordinate-descent] + sequential-thresholding" 11, "irls-l1[nlopt] + information-criterion" 12, "irls-l1[nlopt] + keep-all" 13, "irls-l1[nlopt] + minor-terms" 14, "irls-l1[nlopt] + sequential-thresholding" 15, "ols + information-criterion" 16, "ols + keep-all" 17, "ols + minor-terms" 18, "ols + sequential-thresholding" 19, "stlsq + information-criterion" 20, "stlsq + keep-all" 21, "stlsq + minor-terms" 22, "stlsq + sequential-thresholding" 23)
set yrange [24-0.5:-0.5]
set xrange [-0.5:15-0.5]
set cbrange [0:100]
set palette defined (0 '#f7f7f7', 50 '#92c5de', 100 '#4393c3')
set tics scale 0
unset key
set colorbox
plot 'rossler.dat' matrix with image pixels, \
  'rossler.dat' matrix using 1:2:(sprintf('%.0f', $3)) with labels font ',11'
