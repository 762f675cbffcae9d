local h = history.file{ file = "furlongs.csv" }
