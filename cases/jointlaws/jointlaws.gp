# Boon (2013), Figs 4.29 and 4.32 (b) as far as they are formulas. Lines: closed form; points: the law driver.
set terminal svg size 1080,420 @page
set multiplot layout 1,3 margins 0.075,0.985,0.15,0.78 spacing 0.095
set key above vertical maxrows 4 samplen 2
set xlabel 'closure (µm)'
set ylabel 'normal stress (MPa)'
set xrange [0:450]
set yrange [0:4]
laws = 'constant linear hardening power'
names = '"10 GPa/m" "linear, Eq. 4.12" "linear, Eq. 4.14" "power, Eq. 4.13"'
plot for [k=1:4] word(laws, k).'_normal.csv' using 'closure_um':'closed_form_MPa' with lines lt k notitle, \
     for [k=1:4] word(laws, k).'_normal.csv' using 'closure_um':'stress_MPa' every 12 with points lt k title word(names, k)
set xlabel 'slip (µm)'
set ylabel 'shear stress (MPa)'
set xrange [0:400]
set yrange [0:3.6]
stresses = '0.5 1 2 4'
part(name, k) = abs(column('normal_MPa') - real(word(stresses, k))) < 1e-6 ? column(name) : NaN
do for [law in 'hardening softening'] {
  plot for [k=1:4] law.'_shear.csv' using 'slip_um':(part('closed_form_MPa', k)) with lines lt k notitle, \
       for [k=1:4] law.'_shear.csv' using 'slip_um':(part('shear_MPa', k)) every 10 with points lt k \
         title word(stresses, k).' MPa, '.(law eq 'hardening' ? 'Eq. 4.18' : 'softening')
}
unset multiplot
