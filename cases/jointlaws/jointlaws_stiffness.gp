# Boon (2013), Figs 4.17, 4.31 and 4.30 (b) as far as they are formulas: stiffness against stress and against slip
set terminal svg size 1080,420 @page
set multiplot layout 1,3 margins 0.075,0.985,0.15,0.78 spacing 0.095
set key above vertical maxrows 4 samplen 2
set xlabel 'normal stress (MPa)'
set ylabel 'normal stiffness (GPa/m)'
plot 'stiffness.csv' using 'stress_MPa':'linear_normal_GPa_per_m' with lines lt 1 title 'linear, Eq. 4.10', \
     '' using 'stress_MPa':'power_normal_GPa_per_m' with lines lt 2 title 'power, Eq. 4.13'
set ylabel 'initial shear stiffness (GPa/m)'
plot 'stiffness.csv' using 'stress_MPa':'linear_shear_GPa_per_m' with lines lt 1 title 'linear, Eq. 4.11', \
     '' using 'stress_MPa':'power_shear_GPa_per_m' with lines lt 2 title 'power, Eq. 4.17'
set xlabel 'slip (µm)'
set ylabel 'shear stiffness (GPa/m)'
stresses = '0.5 1 2 4'
plot for [k=1:4] 'degrading.csv' using 'slip_um':(abs(column('normal_MPa') - real(word(stresses, k))) < 1e-6 ? \
       column('stiffness_GPa_per_m') : NaN) with lines lt k title word(stresses, k).' MPa, Eq. 4.15'
unset multiplot
