# Boon (2013), Fig. 4.9: time per contact against the number of planes. Lines join the five regular shapes; open marks
# are joint-cut blocks.
set datafile missing NaN
set logscale xy
set xlabel 'planes of both parts'
set ylabel 'time per contact problem (µs)'
set xrange [6.5:50]
set xtics (8, 12, 16, 24, 32, 40)
set yrange [0.02:*]
set format y '10^{%T}'
set key noautotitle width -2 maxrows 2
file = 'contact_planes.csv'
array column_of[6] = ['ipopt_us', 'glpk_cold_us', 'glpk_warm_us', 'own_centre_us', 'own_lp_us', 'own_contact_us']
array name[6] = ['centre: Ipopt', 'LP: GLPK, cold', 'LP: GLPK, warm', 'centre: ours, cold', 'LP: ours, cold', 'whole contact: ours, warm']
array colour[6] = [4, 2, 5, 3, 1, 7]
array open_mark[6] = [12, 4, 10, 8, 6, 6]
array full_mark[6] = [13, 5, 11, 9, 7, 7]
block = 'joint-cut block'
of_five(value) = strcol('shape') eq block ? NaN : value
of_block(value) = strcol('shape') eq block ? value : NaN
plot for [i=1:6] file using (of_five(column('planes'))):(column(column_of[i])) with linespoints lt colour[i] \
         pt full_mark[i] title name[i], \
     for [i=1:6] file using (of_block(column('planes'))):(column(column_of[i])) with points lt colour[i] \
         pt open_mark[i] ps 0.9
