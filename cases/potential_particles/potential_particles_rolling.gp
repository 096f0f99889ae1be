# a rounded square that rolls over its corner: the angle over time, this run and quadrature
set xlabel 'time (s)'
set ylabel 'leans by that much more (deg)'
set xrange [0:*]
set yrange [0:37]
set key left top
radii = '0.01 0.1 0.3'
plot for [k=1:3] 'rolling_theory.csv' using (abs(column('radius') - real(word(radii, k))) < 1e-6 ? column('time_s') : NaN):'turned_deg' \
       with lines lc k lw 1.5 title sprintf('corner of %s m: quadrature', word(radii, k)), \
     for [k=1:3] 'rolling.csv' using (abs(column('radius') - real(word(radii, k))) < 1e-6 ? column('time_s') : NaN):'turned_deg' \
       with points lc k pt 6 notitle
