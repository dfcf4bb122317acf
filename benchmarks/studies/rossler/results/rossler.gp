set terminal svg size 1420,1580 font 'sans,12' background 'white'
set output 'rossler.svg'
set title 'Rossler, 20 candidate terms: runs with exactly the true terms (%)'
set lmargin at screen 0.274648
set rmargin at screen 1-0.070423
set bmargin at screen 0.126582
set tmargin at screen 1-0.025316
set xtics rotate by 35 right ("exact 0 %%" 0, "exact 0.1 %%" 1, "exact 1 %%" 2, "integral 0 %%" 3, "integral 0.1 %%" 4, "integral 1 %%" 5, "strong[finite-differences] 0 %%" 6, "strong[finite-differences] 0.1 %%" 7, "strong[finite-differences] 1 %%" 8, "strong[savitzky-golay] 0 %%" 9, "strong[savitzky-golay] 0.1 %%" 10, "strong[savitzky-golay] 1 %%" 11, "weak 0 %%" 12, "weak 0.1 %%" 13, "weak 1 %%" 14)
set ytics ("best-subset + cross-validation" 0, "best-subset + information-criterion" 1, "best-subset + keep-all" 2, "best-subset + minor-terms" 3, "best-subset + sequential-thresholding" 4, "elastic-net + cross-validation" 5, "elastic-net + information-criterion" 6, "elastic-net + keep-all" 7, "elastic-net + minor-terms" 8, "elastic-net + sequential-thresholding" 9, "ensemble + cross-validation" 10, "ensemble + information-criterion" 11, "ensemble + keep-all" 12, "ensemble + minor-terms" 13, "ensemble + sequential-thresholding" 14, "frols + cross-validation" 15, "frols + information-criterion" 16, "frols + keep-all" 17, "frols + minor-terms" 18, "frols + sequential-thresholding" 19, "gls + cross-validation" 20, "gls + information-criterion" 21, "gls + keep-all" 22, "gls + minor-terms" 23, "gls + sequential-thresholding" 24, "irls + cross-validation" 25, "irls + information-criterion" 26, "irls + keep-all" 27, "irls + minor-terms" 28, "irls + sequential-thresholding" 29, "irls-l1[any] + cross-validation" 30, "irls-l1[any] + information-criterion" 31, "irls-l1[any] + keep-all" 32, "irls-l1[any] + minor-terms" 33, "irls-l1[any] + sequential-thresholding" 34, "ols + cross-validation" 35, "ols + information-criterion" 36, "ols + keep-all" 37, "ols + minor-terms" 38, "ols + sequential-thresholding" 39, "ridge + cross-validation" 40, "ridge + information-criterion" 41, "ridge + keep-all" 42, "ridge + minor-terms" 43, "ridge + sequential-thresholding" 44, "sr3 + cross-validation" 45, "sr3 + information-criterion" 46, "sr3 + keep-all" 47, "sr3 + minor-terms" 48, "sr3 + sequential-thresholding" 49, "stlsq + cross-validation" 50, "stlsq + information-criterion" 51, "stlsq + keep-all" 52, "stlsq + minor-terms" 53, "stlsq + sequential-thresholding" 54)
set yrange [55-0.5:-0.5]
set xrange [-0.5:15-0.5]
set cbrange [0:100]
set palette defined (0 '#f7f7f7', 50 '#92c5de', 100 '#4393c3')
set tics scale 0
unset key
set colorbox
plot 'rossler.dat' matrix with image pixels, \
  'rossler.dat' matrix using 1:2:(sprintf('%.0f', $3)) with labels font ',11'
