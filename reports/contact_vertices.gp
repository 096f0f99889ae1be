# Boon (2013), Fig. 4.10: analytic centre against centroid, by number of vertices
set xlabel 'number of vertices'
set ylabel 'time (µs)'
set xrange [0:40]
set logscale y
set yrange [0.1:100]
set key noautotitle
file = 'contact_vertices.csv'
plot file using 'vertices':'centroid_us'      with points lt 4 ps 1.1 title 'centroid by exact clip', \
     file using 'vertices':'lp_and_centre_us' with points lt 3 ps 1.1 title 'LP and analytic centre', \
     file using 'vertices':'centre_us'        with points lt 2 ps 1.1 title 'analytic centre', \
     file using (column('vertices')):(column('centroid_us') > column('centre_us') ? column('centroid_us') : column('centre_us')):(strcol('shape')) \
         with labels rotate by 60 left offset 0.2,0.8 font ',11' tc rgb '#606060'
