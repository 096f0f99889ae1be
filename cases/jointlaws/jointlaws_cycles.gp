# two shear cycles of the hardening joint: constant normal load, and surroundings of constant normal stiffness
set xlabel 'slip (µm)'
set ylabel 'shear stress (MPa)'
set y2label 'normal stress (MPa)'
set y2tics
set y2range [0:4]
set xrange [-220:220]
plot 'load_loop.csv' using 'slip_um':'shear_MPa' with lines lt 1 title 'constant normal load', \
     'stiffness_loop.csv' using 'slip_um':'shear_MPa' with lines lt 2 title 'constant normal stiffness', \
     '' using 'slip_um':'normal_MPa' axes x1y2 with lines lt 2 dt 2 lw 1 title 'its normal stress'
