# the radius r: tilt near an edge in units of r, and effect of r from too small to too large
set terminal svg size 1080,460 @page
set multiplot layout 1,2 margins 0.07,0.72,0.15,0.95 spacing 0.09

set xlabel 'distance from the edge over r'
set ylabel 'tilt of the normal (deg)'
set yrange [0:50]
set key at graph 0.98,0.98 right top vertical
degrees = 57.29577951308232
radii = '0.001 0.01 0.1 0.3'
plot 'tilt.csv' using 'distance':(column('exact') * degrees) smooth unique @theory title 'atan(⟨r − e⟩/(r − u/2))', \
     for [k=1:4] 'tilt.csv' using 'distance': \
       (abs(column('radius') / real(word(radii, k)) - 1) < 1e-6 ? column('tilt') * degrees : NaN) every k::k \
       with points lt k title sprintf('r = %s of the size', word(radii, k))

set xlabel 'r over the overlap (1 % of the size)'
set ylabel 'normal (rad)'
set logscale xy
set format y '10^{%T}'
set yrange [1e-5:1]
set y2range [0:1]
set y2label 'fraction of the contacts'
set y2tics 0.25
set key at screen 0.995,0.95 right top vertical
plot 'radius.csv' using 'radius':(column('tilt') > 1e-9 ? column('tilt') : NaN) with linespoints lt 2 \
       title 'tilt of face contacts', \
     '' using 'radius':(column('change') > 1e-9 ? column('change') : NaN) with linespoints lt 1 \
       title 'rotation of a corner''s, 1 % more', \
     '' using 'radius':'deep' axes x1y2 with lines lt 3 title 'deeper than r (fraction)', \
     '' using 'radius':'without' axes x1y2 with lines lt 4 title 'no gradient (fraction)', \
     'rule.csv' using 'radius':'share' axes x1y2 with lines lt 7 dt 2 title 'the rule'
unset multiplot
