# All checks, computed against expected. draw.sh passes: points (checks.csv), and others that only checks_errors.gp needs.
set terminal svg size 760,420
set logscale xy
set format xy '10^{%T}'
set xtics 1e4
set ytics 1e4
set mxtics 1
set mytics 1
of(title, side) = strcol('group') eq title && strcol('side') eq side ? column('expected') : NaN
set xlabel 'expected, in the unit of each check'
set key inside bottom right vertical samplen 1
# both panels have the range of all checks
stats points using 'expected' nooutput
low = STATS_min; high = STATS_max
stats points using 'computed' nooutput
low = 10 ** floor(log10(low < STATS_min ? low : STATS_min)); high = 10 ** ceil(log10(high > STATS_max ? high : STATS_max))
set xrange [low:high]
set yrange [low:high]
set multiplot
set tmargin at screen 0.91
set bmargin at screen 0.15
set lmargin at screen 0.11
set rmargin at screen 0.52
set ylabel 'computed, in the unit of each check'
set title 'Verification' offset 0, -0.4
plot x with lines lw 1 lc rgb '#808080' notitle, \
     points using (of('Verification', 'both')):'computed' with points pt 7 ps 0.4 lc rgb '#0072b2' title 'a check', \
     points using (of('Verification', 'one')):'computed' with points pt 6 ps 0.6 lc rgb '#404040' title 'an inequality'
set lmargin at screen 0.57
set rmargin at screen 0.98
unset ylabel
set title 'Validation'
plot x with lines lw 1 lc rgb '#808080' notitle, \
     points using (of('Validation', 'both')):'computed' with points pt 4 ps 0.6 lw 1.5 lc rgb '#d55e00' title 'a check', \
     points using (of('Validation', 'one')):'computed' with points pt 6 ps 0.6 lc rgb '#404040' title 'an inequality'
unset multiplot
