# the largest force of each bolt of the first trial along the wall
set xlabel 'angle from the springline to the right (°)'
set ylabel 'largest force of a bolt over p_0 D'
set xrange [-30:210]
set yrange [0:*]
set xtics 45
set key right top
plot 'support_bolts.csv' using (column('angle_deg')):(column('force')) @computed title 'let off in steps', \
     0.030 @theory title 'Boon (2013): largest, sudden removal'
