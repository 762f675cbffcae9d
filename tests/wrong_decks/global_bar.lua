local pressure = 20*bar
