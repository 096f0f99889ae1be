# error of a face on n x n points against the distributed joint, and cost of a contact in a step; dashed: integrated face contact
set terminal svg size 980,460 @page
set logscale xy
set multiplot layout 1,2 margins 0.09,0.98,0.14,0.79 spacing 0.1
set xlabel 'points along a face'
set xtics (1, 2, 4, 8, 16)
set xrange [0.85:19]
set ylabel 'error, of the distributed joint'
set yrange [3e-9:5]
set format y '10^{%T}'
set key outside top center horizontal maxcols 3
plot 'square.csv' using 'along':'spin' with linespoints lt 1 title 'spin stiffness', \
     'square.csv' using 'along':'spin_strength' with linespoints lt 2 title 'spin strength', \
     'square.csv' using 'along':'rocking' with linespoints lt 3 title 'rocking stiffness'
set ylabel 'a contact in a step, this run (µs)'
set yrange [0.3:100]
set format y '%g'
plot 'square.csv' using 'along':(column('nanoseconds')/1000) with linespoints lt 1 title 'square, n × n points', \
     'strip.csv' using 'along':(column('nanoseconds')/1000) with linespoints lt 2 title 'in the plane, n points', \
     'whole.csv' using 'along':(column('square')/1000) with lines lt 1 dt 2 title 'square, integrated', \
     'whole.csv' using 'along':(column('strip')/1000) with lines lt 2 dt 2 title 'in the plane, integrated'
unset multiplot
