# Above: tracking error of joint 1 with both couplings. Below: a hinge released at an error of 178 degrees.
set terminal svg size 700,620 font "sans,13" background "white"
set output "out/lag.svg"
set datafile separator ","
set grid lc rgb "#dddddd"
set multiplot layout 2,1
set xlabel "t [s]"
set ylabel "tracking error of joint 1 [deg]"
error(twin, own) = (twin - own) * 180 / pi
plot "out/torsional.dat" using 1:2 with lines lw 2 lc 7 title "torsional", \
     "out/linear.dat" using 1:2 with lines lw 2 lc 6 title "linear"
set key center right
set ylabel "hinge [deg]"
plot "out/hinge_torsional.csv" using "t[s]":(column("q/hinge[rad]") * 180 / pi) with lines lw 2 lc 7 title "torsional", \
     "out/hinge_linear.csv" using "t[s]":(column("q/hinge[rad]") * 180 / pi) with lines lw 2 lc 6 title "linear, at 1 m"
