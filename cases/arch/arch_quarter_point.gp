# The arch under a point load at the quarter of its span: stable, collapsing, load against drop, and the collapse
# load against the stiffness of the joints.
set terminal svg size 980,730 @page
needle = 100e3                 # N/m: drawn 1 m long
rigid = real(system("sed -n 2p quarter_rigid.csv"))
set multiplot

# the two pictures
@picture
set size 0.5, 0.42
set lmargin 0
set rmargin 0
set tmargin 0
set bmargin 0
set xrange [-6.3:6.3]
set yrange [-0.8:6.6]
do for [side = -1:1:2] {
  set object 2 + side rectangle from side*4.1, -0.55 to side*6.0, 0 fc rgb '#d9d9d9' fs solid noborder behind
  set arrow 2 + side from side*4.1, 0 to side*6.0, 0 nohead lc rgb '#606060' lw 1.5 back
}
set arrow 9 from -2.5, 6.25 to -2.5, 4.8 head filled size 0.3, 20 lc rgb '#202020' lw 2.5 front
set key at first 0, 1.9 center vertical samplen 3 spacing 1.3 noautotitle

set origin 0, 0.57
set label 1 'stable' at 0, 3.35 center font ',17'
set label 2 'under 60 kN/m, on joints of 100 GPa/m' at 0, 2.8 center
set arrow 10 from -0.5, 0.45 to 0.5, 0.45 nohead lc rgb '#0072b2' lw 4
set label 10 '100 kN/m' at 0, 0.12 center tc rgb '#0072b2'
plot 'quarter_standing.csv' using 1:2 @stone, \
     'quarter_forces.csv' using ($1 - 0.5*$3/needle):($2 - 0.5*$4/needle):($3/needle):($4/needle) \
         with vectors nohead lc rgb '#0072b2' lw 4 title 'forces in the joints', \
     'quarter_thrust.csv' using 1:2 with lines lc rgb '#d55e00' lw 1.8 title 'thrust line'

set origin 0.5, 0.57
unset arrow 10
unset label 10
set label 1 'collapses'
set label 2 sprintf('under %.1f kN/m', rigid)
set label 3 'when a block has dropped by 0.25 m' at 0, 2.3 center
set key at first 0, 1.35
plot 'quarter_standing.csv' using 1:2 with lines lc rgb '#a0a0a0' lw 1 dt 3 title 'before', \
     'quarter_falling.csv' using 1:2 @stone, \
     'quarter_hinges.csv' using 1:2 with points pt 7 ps 1.1 lc rgb '#d55e00' title 'hinges', \
     '' using 1:2 with points pt 6 ps 1.1 lw 1.2 lc rgb '#202020'
unset arrow
unset object
unset label

# the two plots
set size noratio 0.5, 0.54
set lmargin 9
set rmargin 2
set tmargin 1
set bmargin 4
set border 3 lc rgb '#606060' lw 1
set xtics nomirror out scale 0.6 textcolor rgb '#202020'
set ytics nomirror out scale 0.6 textcolor rgb '#202020'
set grid back lc rgb '#e2e2e2' lw 1 dt 1
set key at graph 0.98, 0.04 right bottom vertical samplen 2.5 spacing 1.1
set ylabel 'point load (kN/m)'
set yrange [0:80]

set origin 0, 0
set xlabel 'drop of its point (mm)'
set xrange [0:12]
plot 'quarter_path_1000.csv' using 'drop_mm':'load_kN' with lines lt 1 title '1000 GPa/m', \
     'quarter_path_100.csv' using 'drop_mm':'load_kN' with lines lt 2 title '100 GPa/m', \
     'quarter_rests_100.csv' using 'drop_mm':'load_kN' with points lt 2 pt 7 notitle, \
     'quarter_path_10.csv' using 'drop_mm':'load_kN' with lines lt 3 title '10 GPa/m', \
     'quarter_rests_10.csv' using 'drop_mm':'load_kN' with points lt 3 pt 7 title 'DEM, in equilibrium', \
     rigid with lines lc rgb '#404040' lw 1.5 dt 2 title 'limit analysis'

set origin 0.5, 0
set xlabel 'normal stiffness of the joints (GPa/m)'
set logscale x
set format x '10^{%T}'
set xrange [5:30000]
set yrange [45:72]
plot 'quarter_limit.csv' using 'stiffness_GPa_m':'load_kN' @theory title 'rigid voussoirs on elastic joints', \
     rigid with lines lc rgb '#404040' lw 1.5 dt 2 title 'limit analysis', \
     'quarter_found.csv' using 'stiffness_GPa_m':'load_kN' with points lc rgb '#d55e00' pt 7 ps 1 title 'DEM, found by search'
unset multiplot
