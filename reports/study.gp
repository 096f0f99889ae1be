# Work and precision of one case's study. draw.sh passes: points (csv), sweeps (names, as words), quantity, cost
# ('contact evaluations' or 'steps', the unit of the recommendation), default ('yes': the scene as it is has a result).
set terminal svg size 760,880
set datafile missing NaN
set logscale xy
set format x '10^{%T}'
set format y '10^{%T}'
set offsets graph 0.04, graph 0.06, graph 0.08, graph 0.06
set ylabel 'relative error of '.quantity noenhanced

# the three accuracies of the recommendations
do for [level in '0.05 0.01 0.001'] {
  set arrow from graph 0, first level + 0 to graph 1, first level + 0 nohead dt 3 lw 1 lc rgb '#808080' back
}
set label 1 '5 %'   at graph 1.005, first 0.05  font ',11' tc rgb '#606060'
set label 2 '1 %'   at graph 1.005, first 0.01  font ',11' tc rgb '#606060'
set label 3 '0.1 %' at graph 1.005, first 0.001 font ',11' tc rgb '#606060'

# each a word of its own, even with blanks
count = words(sweeps)

# a row belongs to the curve when quantity and sweep agree; the others are left out without breaking the line
of(sweep, value) = (strcol('quantity') eq quantity && strcol('sweep') eq sweep) ? value : NaN
best(value) = (strcol('quantity') eq quantity && strcol('pareto') eq 'yes') ? value : NaN
error = 'column("relative_error")'
upper = 'column("relative_error_upper")'
curves = "for [i=1:count] points using (of(word(sweeps, i), @work)):(@error):(0):(@upper - @error) with vectors nohead lt i lw 1 notitle, \
     for [i=1:count] points using (of(word(sweeps, i), @work)):(@error) with linespoints lt i title word(sweeps, i) noenhanced, \
     points using (best(@work)):(@error) with points pt 6 ps 1.5 lw 1.5 lc rgb '#202020' title 'Pareto front'"
if (default eq 'yes') {
  curves = curves.", points using (of('default', @work)):(@error) with points pt 3 ps 1.2 lw 1.5 lc rgb '#202020' title 'the scene as it is'"
}

set multiplot
set lmargin at screen 0.11
set rmargin at screen 0.93
set tmargin at screen 0.84
set bmargin at screen 0.46
set key at screen 0.93, screen 0.995 right top vertical maxcols 2 maxrows 6 samplen 2 spacing 1.0
set xlabel cost
work = cost eq 'steps' ? 'column("steps")' : 'column("contact_evaluations")'
plot @curves

# the same over steps and over seconds of this machine
set key off
unset label
set tmargin at screen 0.37
set bmargin at screen 0.08
set rmargin at screen 0.49
set xlabel 'steps'
work = 'column("steps")'
plot @curves
set lmargin at screen 0.60
set rmargin at screen 0.98
unset ylabel
set xlabel 'seconds, several runs at a time'
work = 'column("seconds")'
plot @curves
unset multiplot
