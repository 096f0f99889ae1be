# thrust and moment of a lining of 0.3 m
set terminal svg size 1000,420 @page
set xlabel 'angle from the springline to the right (°)'
set xrange [-90:270]
set xtics 90
set multiplot layout 1,2
set ylabel 'thrust (MN/m)'
set yrange [0:*]
unset key
plot 'support_lining.csv' using (column('angle_deg')):(1e-6*column('thrust_N')) @computed
set ylabel 'moment, sagging (kN m/m)'
set yrange [*:*]
set key top right
plot 'support_lining.csv' using (column('angle_deg')):(1e-3*column('moment_Nm')) @computed title 'lining', \
     '' using (column('angle_deg')):(1e-3*column('smoothed_moment_Nm')) @theory title 'smoothed (appendix I)'
unset multiplot
