# All checks, computed against expected. draw.sh passes: points (checks.csv), means, verification and validation (unused here).
load style
set terminal svg size 760,420
set output out
set logscale xy
set format xy '10^{%T}'
of(title) = strcol('group') eq title ? column('expected') : NaN
set xlabel 'expected, in the unit of each check'
set key bottom right inside
set multiplot
set tmargin at screen 0.90
set bmargin at screen 0.15
set xtics 1e4
set ytics 1e4
# both panels have the ranges of all checks
stats points using 'expected' nooutput
low = 10 ** floor(log10(STATS_min)); high = 10 ** ceil(log10(STATS_max))
set xrange [low:high]
set yrange [low:high]
set lmargin at screen 0.11
set rmargin at screen 0.51
set ylabel 'computed, in the unit of each check'
set title 'Verification'
plot x with lines lw 1 lc rgb '#808080' notitle, \
     points using (of('Verification')):'computed' with points pt 7 ps 0.4 lc rgb '#0072b2' title 'a check'
set lmargin at screen 0.57
set rmargin at screen 0.97
unset ylabel
set title 'Validation'
plot x with lines lw 1 lc rgb '#808080' notitle, \
     points using (of('Validation')):'computed' with points pt 4 ps 0.6 lc rgb '#d55e00' title 'a check'
unset multiplot
