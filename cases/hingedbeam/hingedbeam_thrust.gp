# Boon (2013), Fig. 4.15 (b): horizontal thrust against the weight of a block
set xlabel 'weight of a block (kN)'
set ylabel 'horizontal thrust (kN)'
set xrange [0:42]
set yrange [0:240]
set key maxrows 3
# built without Ipopt, the same fast push by our Newton
with_ipopt = int(system('[ -f ipopt.csv ] && echo 1 || echo 0'))
fast_push = with_ipopt ? 'ipopt.csv' : 'newton.csv'
solver = with_ipopt ? 'Ipopt' : 'fast push'
plot 'second_order.csv' using 'weight_kN':'thrust_kN' @theory title 'closed form E.2', \
     'centroid_reference.csv' using 'weight_kN':'thrust_kN' with lines lc rgb '#d55e00' lw 1 notitle, \
     'centroid.csv' using 'weight_kN':'thrust_kN' every 6 @computed title 'centroid', \
     'centre_reference.csv' using 'weight_kN':'thrust_kN' with lines lc rgb '#0072b2' lw 1 notitle, \
     'centre.csv' using 'weight_kN':'thrust_kN' every 6 with points lt 1 title 'centre, own Newton', \
     fast_push using 'weight_kN':'thrust_kN' every 6::3 with points lt 3 pt 8 ps 1 title 'centre, '.solver, \
     'aligned_centre_reference.csv' using 'weight_kN':'thrust_kN' with lines lc rgb '#56b4e9' lw 1 notitle, \
     'aligned_centre.csv' using 'weight_kN':'thrust_kN' every 6 with points lt 6 title 'centre, aligned abutments'
