# force of a bar whose bond slips as its joint opens
set xlabel 'opening of the joint (mm)'
set ylabel 'force of the bar (kN)'
set xrange [0:1.02]
set key left top
plot 'grouted.csv' using (1e3*column('opening_m')):(1e-3*column('slipping_closed_form_N')) @theory title 'closed form', \
     '' using (1e3*column('opening_m')):(1e-3*column('slipping_N')) every 5 @computed title 'nodes 20 mm apart'
