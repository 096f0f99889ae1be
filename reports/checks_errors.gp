# All checks, error over tolerance, case by case. draw.sh passes: points (checks.csv), means (checks_cases.csv), verification
# and validation (the cases of each, as words), verification_spread and validation_spread (bias and scatter of each).
upper = words(verification)
lower = words(validation)
row = 18.0                                   # of a case, in pixels
top = 62; between = 74; bottom = 50          # pixels: legend and title; axis and title; axis
height = top + row * (upper + 0.4) + between + row * (lower + 0.4) + bottom
set terminal svg size 760,height
set xrange [-1.5:1.5]
set xtics 0.5
set grid noytics
# within the tolerance
set object 1 rect from -1, graph 0 to 1, graph 1 behind fc rgb '#eceff2' fs solid noborder
set arrow 1 from 0, graph 0 to 0, graph 1 nohead lc rgb '#606060' lw 1 back
of(title, name) = strcol('group') eq title ? column(name) : NaN
mean = "with xerrorbars pt 2 ps 0.7 lw 1.5 lc rgb '#000000'"
set lmargin at screen 0.19
set rmargin at screen 0.97
set key at screen 0.58, screen 1 - 6 / height center top horizontal samplen 1
set multiplot
set tmargin at screen 1 - top / height
set bmargin at screen 1 - (top + row * (upper + 0.4)) / height
set yrange [upper + 0.7 : 0.3]
set ytics scale 0 () noenhanced
set for [i=1:upper] ytics add (word(verification, i) i)
set title 'Verification: '.verification_spread offset 0, -0.5
plot points using (of('Verification', 'over_tolerance')):'place' with points pt 7 ps 0.35 lc rgb '#0072b2' title 'a check', \
     means using (of('Verification', 'mean')):'place':'deviation' @mean title 'mean and scatter of a case'
set key off
set tmargin at screen (bottom + row * (lower + 0.4)) / height
set bmargin at screen bottom / height
set yrange [lower + 0.7 : 0.3]
set ytics scale 0 () noenhanced
set for [i=1:lower] ytics add (word(validation, i) i)
set title 'Validation: '.validation_spread
set xlabel '(computed − expected) / tolerance'
plot points using (of('Validation', 'over_tolerance')):'place' with points pt 4 ps 0.6 lw 1.5 lc rgb '#d55e00', \
     means using (of('Validation', 'mean')):'place':'deviation' @mean
unset multiplot
