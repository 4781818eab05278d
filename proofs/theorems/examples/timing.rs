use mufasa_theorems::{prove::judge, theorem};
fn main() {
    let names: Vec<String> = std::env::args().skip(1).collect();
    for t in theorem::all().filter(|t| names.iter().any(|n| t.id.contains(n.as_str()))) {
        let j = judge(t).unwrap();
        let c = format!("{:?}", j.control); 
        println!("{:<70} claim {:?} control {} paths {} {:.1?}", t.id, j.claim, &c[..c.len().min(60)], j.paths, j.time);
    }
}
