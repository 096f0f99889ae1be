# force of a bolt's spring as its joint slips and opens by a twentieth of the slip
set xlabel 'slip of the joint (mm)'
set ylabel 'force of the bolt (kN)'
set xrange [0:20.5]
set key left top
plot 'slip.csv' using (1e3*column('slip_m')):(1e-3*column('offset_closed_form_N')) @theory title 'closed forms', \
     '' using (1e3*column('slip_m')):(1e-3*column('at_joint_closed_form_N')) @theory notitle, \
     '' using (1e3*column('slip_m')):(1e-3*column('midway_closed_form_N')) @theory notitle, \
     '' using (1e3*column('slip_m')):(1e-3*column('offset_N')) every 5 @computed title 'anchors 34 mm from the joint', \
     '' using (1e3*column('slip_m')):(1e-3*column('at_joint_N')) every 5::2 with points lc rgb '#0072b2' pt 4 ps 0.8 title 'at the joint', \
     '' using (1e3*column('slip_m')):(1e-3*column('midway_N')) every 5::3 with points lc rgb '#009e73' pt 9 ps 0.7 title 'midway in the blocks'
