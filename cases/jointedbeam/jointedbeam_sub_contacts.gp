# error against the distributed joint by number of sub-contacts
set logscale xy
set xlabel 'sub-contacts of a joint'
set ylabel 'largest error at 10, 20, 30, 40 g (%)'
set xrange [3:42]
set yrange [0.0005:5]
set xtics (4, 8, 16, 32)
plot 'sub_contacts.csv' using 'sub_contacts':'deflection_percent' with linespoints lt 2 ps 0.9 title 'mid-span deflection', \
     'sub_contacts.csv' using 'sub_contacts':'thrust_percent' with linespoints lt 1 ps 0.9 title 'thrust'
