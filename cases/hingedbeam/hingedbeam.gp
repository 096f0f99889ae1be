# Boon (2013), Fig. 4.15 (a): weight of a block against its rotation. Lines: closed form and references; points: this run.
set xlabel 'rotation (rad)'
set ylabel 'weight of a block (kN)'
set xrange [0:0.22]
set yrange [0:42]
set key maxrows 3
# built without Ipopt, the same fast push by our Newton
with_ipopt = int(system('[ -f ipopt.csv ] && echo 1 || echo 0'))
fast_push = with_ipopt ? 'ipopt.csv' : 'newton.csv'
solver = with_ipopt ? 'Ipopt' : 'fast push'
plot 'first_order.csv' using 'rotation_rad':'weight_kN' with lines lc rgb '#a0a0a0' lw 1.5 dt 2 title 'first order', \
     'second_order.csv' using 'rotation_rad':'weight_kN' @theory title 'closed form E.2', \
     'centroid_reference.csv' using 'rotation_rad':'weight_kN' with lines lc rgb '#d55e00' lw 1 notitle, \
     'centroid.csv' using 'rotation_rad':'weight_kN' every 6 @computed title 'centroid', \
     'centre_reference.csv' using 'rotation_rad':'weight_kN' with lines lc rgb '#0072b2' lw 1 notitle, \
     'centre.csv' using 'rotation_rad':'weight_kN' every 6 with points lt 1 title 'centre, own Newton', \
     fast_push using 'rotation_rad':'weight_kN' every 6::3 with points lt 3 pt 8 ps 1 title 'centre, '.solver, \
     'aligned_centre_reference.csv' using 'rotation_rad':'weight_kN' with lines lc rgb '#56b4e9' lw 1 notitle, \
     'aligned_centre.csv' using 'rotation_rad':'weight_kN' every 6 with points lt 6 title 'centre, aligned abutments'
