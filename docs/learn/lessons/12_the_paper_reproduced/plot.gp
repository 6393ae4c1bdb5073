# Tracking error of joint 1 in each of the runs.
set terminal svg size 760,640 font "sans,13" background "white" noenhanced
set output "out/errors.svg"
set datafile separator ","
set grid lc rgb "#dddddd"
set key outside right
set multiplot layout 2,1
set xlabel "t [s]"
set ylabel "tracking error of joint 1 [deg]"
set yrange [-25:25]
plot "out/E3.dat" using 1:2 with lines lw 2 lc 7 title "E3", \
     "out/E3_stiffer.dat" using 1:2 with lines lw 1 lc 4 title "E3, 5 % stiffer", \
     "out/E3_damped.dat" using 1:2 with lines lw 2 lc 2 title "E3, damped"
set yrange [-4:4]
plot "out/E4.dat" using 1:2 with lines lw 2 lc 6 title "E4", \
     "out/fair_torsional.dat" using 1:2 with lines lw 2 lc 7 title "fair, torsional", \
     "out/fair_linear.dat" using 1:2 with lines lw 2 lc 2 title "fair, linear"
