local f = frame{ angle = 30 }
