# Boon (2013), Figs 4.20 and 4.22: deflection profiles. Lines: chain; points: this run, at both ends of every block.
set terminal svg size 760,700
set multiplot layout 2,1
set xlabel 'position from the left abutment (mm)'
set ylabel 'displacement (mm)'
set xrange [0:276]
set xtics 46
set key maxrows 2
set title 'full block' offset 0,-0.8
array of_full[4] = ['10', '20', '30', '40']
plot for [i=1:4] 'full_profiles_chain.csv' using 'position_mm':of_full[i].'_g' with lines lt i lw 1.5 notitle, \
     for [i=1:4] 'full_profiles.csv' using 'position_mm':of_full[i].'_g' with points lt i title of_full[i].' g'
set title 'half block'
array of_half[5] = ['10', '30', '50', '70', '77']
plot for [i=1:5] 'half_profiles_chain.csv' using 'position_mm':of_half[i].'_g' with lines lt i lw 1.5 notitle, \
     for [i=1:5] 'half_profiles.csv' using 'position_mm':of_half[i].'_g' with points lt i title of_half[i].' g'
unset multiplot
