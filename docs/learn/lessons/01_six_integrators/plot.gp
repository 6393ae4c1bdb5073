# Energy of each integrator relative to the initial energy; below, the long run.
set terminal svg size 760,640 font "sans,13" background "white"
set output "out/energy.svg"
set datafile separator ","
set key outside right
set grid lc rgb "#dddddd"
set multiplot layout 2,1
energy(kinetic, potential) = (kinetic + potential + 9.81) / (9.81 * (1 - cos(0.01)))
set logscale y
set xlabel "t [s]"
set ylabel "E / E_0"
set title "step 0.01 s"
names = "euler semi-implicit verlet rk4 implicit-midpoint implicit-euler"
plot for [name in names] "out/".name.".csv" using "t[s]":(energy(column("kinetic_energy[J]"), column("potential_energy[J]"))) with lines lw 2 title name
set title "step 0.2 s"
set yrange [1e-4:3]
plot for [name in "semi-implicit rk4"] "out/long-".name.".csv" using "t[s]":(energy(column("kinetic_energy[J]"), column("potential_energy[J]"))) with lines lw (name eq "rk4" ? 2 : 0.3) title name
