# six moments of the collision, with the time of each
set terminal svg size 1000,620 @page
@picture
unset key
set style fill solid 1 noborder
set lmargin 0
set rmargin 0
set xrange [-1.6:1.6]
set yrange [-0.6:1.7]
array times[6]
stats 'vertex_face_times.csv' using (times[int(column('panel'))] = column('time_s')) nooutput
set multiplot layout 2,3
do for [i=1:6] {
  set title sprintf('%.3f s', times[i])
  plot 'vertex_face_'.i.'.csv' using 'right_m':'up_m':'colour' with filledcurves closed lc rgb variable
}
unset multiplot
