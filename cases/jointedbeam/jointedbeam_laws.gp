# Boon (2013), Figs 4.18, 4.21, 4.23 to 4.26 and 4.33 to 4.38 in form: build-up of thrust and deflection profiles under the
# laws that depend on stress. Lines: chain; points: this run.
set terminal svg size 900,760
set multiplot layout 2,2
array law[3] = ['linear', 'half_stiff', 'yielding']
array name[3] = ['linear', 'half as stiff', 'continuously yielding']
array block[2] = ['full', 'half']
array last[2] = ['40', '90']
set key maxrows 3 width -4
do for [b=1:2] {
  set title block[b].' block' offset 0,-0.8
  set xlabel 'gravity (g)'
  set ylabel 'thrust (N)'
  set xrange [0:last[b]+0]
  set xtics auto
  set yrange [0:*]
  plot for [i=1:3] block[b].'_'.law[i].'_chain.csv' using 'gravity_g':'thrust_N' with lines lt i lw 1.5 notitle, \
       for [i=1:3] block[b].'_'.law[i].'.csv' using 'gravity_g':'thrust_N' with points lt i title name[i]
}
do for [b=1:2] {
  set title block[b].' block, '.last[b].' g' offset 0,-0.8
  set xlabel 'position from the left abutment (mm)'
  set ylabel 'displacement (mm)'
  set xrange [0:276]
  set xtics 46
  set yrange [*:0]
  plot for [i=1:3] block[b].'_'.law[i].'_profiles_chain.csv' using 'position_mm':last[b].'_g' with lines lt i lw 1.5 notitle, \
       for [i=1:3] block[b].'_'.law[i].'_profiles.csv' using 'position_mm':last[b].'_g' with points lt i title name[i]
}
unset multiplot
