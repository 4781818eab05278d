//! AMQP 1.0 over a broker. A thread of its own keeps the connection, and makes it again when it ends.
//!
//! All publish to one exchange of kind topic, with the address as the subject, which the broker takes
//! for the routing key; each who listens has two queues (its own and that of all) for each connection,
//! which RabbitMQ keeps when that has ended until a policy of the broker ends them (`docs/link.md`). Messages
//! are sent settled, that is once or never, and the broker keeps them for at most a second: a result that
//! is late is worth nothing.

use std::error::Error;
use std::thread::{self, JoinHandle};
use std::time::Duration;

use fe2o3_amqp::connection::{Connection, OpenError};
use fe2o3_amqp::link::receiver::CreditMode;
use fe2o3_amqp::link::{Receiver, RecvError, Sender};
use fe2o3_amqp::sasl_profile::SaslProfile;
use fe2o3_amqp::session::Session;
use fe2o3_amqp::types::definitions::SenderSettleMode;
use fe2o3_amqp::types::messaging::{Body, Data, Header, Message, Properties};
use fe2o3_amqp::types::primitives::Value;
use fe2o3_amqp::types::sasl::SaslCode;
use percent_encoding::percent_decode_str;
use tokio::net::TcpStream;
use tokio::sync::mpsc;
use tokio::time;
use url::Url;

use super::queue::Queue;
use super::{Address, Health, MESSAGE_MAX, Transport, WAITING_MAX};

/// The exchange; every AMQP broker of this kind has it.
const EXCHANGE: &str = "/exchange/amq.topic";

/// How long the broker keeps a message that nobody takes, ms.
const KEPT_MS: u32 = 1_000;

/// How long a connection may take to be made, and a message to be taken.
const CONNECTED_WITHIN: Duration = Duration::from_secs(5);

/// How long to wait before the next attempt.
const AGAIN_AFTER: Duration = Duration::from_millis(200);

/// A connection on which nothing is heard for so long has ended, ms; the broker says something before.
const SILENT_MS: u32 = 4_000;

/// How many messages the broker may send before it is asked for more.
const CREDIT: u32 = 200;

/// The port of a broker whose address names none.
const PORT: u16 = 5672;

type Sent = (Address, Vec<u8>);

/// One of those who talk over a broker.
#[derive(Debug)]
pub struct Amqp {
    inbox: Queue,
    /// Until it is dropped.
    outbox: Option<mpsc::Sender<Sent>>,
    thread: Option<JoinHandle<()>>,
}

/// Why there is no connection to be had at all.
#[derive(Debug, thiserror::Error)]
pub enum AmqpError {
    /// The address is none of a broker.
    #[error("{url:?} is no address of a broker; write amqp://USER:PASSWORD@HOST:PORT")]
    Url {
        /// What was given, without user and password.
        url: String,
    },
    /// An address with a virtual host.
    #[error(
        "{url:?} names a virtual host, which is not supported: leave out what follows the port"
    )]
    VirtualHost {
        /// What was given, without user and password.
        url: String,
    },
    /// An address with TLS.
    #[error(
        "amqps: this program has no TLS; start a TLS tunnel to the broker, as scripts/link-tls does, and give the \
         amqp://USER:PASSWORD@HOST:PORT of the tunnel"
    )]
    Tls,
    /// The system gives no thread or no sockets.
    #[error("no thread for the connection: {0}")]
    System(std::io::Error),
}

impl Amqp {
    /// Talks over the broker at `url` from now on, as soon as it is there, and whenever it is there
    /// again, until it is dropped.
    ///
    /// Errors: an address that is none, a system without threads or sockets; a broker that cannot be
    /// reached is none, see [`Health::last_error`].
    pub fn new(url: &str, address: Address) -> Result<Self, AmqpError> {
        if url.starts_with("amqps:") {
            return Err(AmqpError::Tls);
        }
        let parsed = Url::parse(url).ok().filter(|it| it.scheme() == "amqp" && it.has_host());
        let given = || without_password(url);
        let url = parsed.ok_or_else(|| AmqpError::Url { url: given() })?;
        if !matches!(url.path(), "" | "/") {
            return Err(AmqpError::VirtualHost { url: given() });
        }
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
        let runtime = runtime.map_err(AmqpError::System)?;
        let inbox = Queue::default();
        let (outbox, sent) = mpsc::channel(WAITING_MAX);
        let queue = inbox.clone();
        let run = move || runtime.block_on(keep_connected(&url, address, &queue, sent));
        let thread = thread::Builder::new().name("amqp".to_owned()).spawn(run);
        let thread = Some(thread.map_err(AmqpError::System)?);
        Ok(Self { inbox, outbox: Some(outbox), thread })
    }
}

impl Drop for Amqp {
    /// Sends what was handed over, if there is a connection, which takes some seconds at most.
    fn drop(&mut self) {
        self.outbox = None;
        if let Some(thread) = self.thread.take() {
            // A panic there has been printed; here it changes nothing.
            drop(thread.join());
        }
    }
}

impl Transport for Amqp {
    fn send(&mut self, _now_ns: i64, to: Address, bytes: Vec<u8>) {
        let is_taken = self.outbox.as_ref().is_some_and(|it| it.try_send((to, bytes)).is_ok());
        if !is_taken {
            self.inbox.note(|health| health.shed += 1);
        }
    }

    fn receive(&mut self, _now_ns: i64) -> Option<Vec<u8>> {
        self.inbox.pop()
    }

    fn wait(&mut self, at_most: Duration) {
        self.inbox.wait(at_most);
    }

    fn health(&self) -> Health {
        self.inbox.health()
    }
}

/// Connects again and again, until the other end of `sent` is dropped.
async fn keep_connected(url: &Url, me: Address, inbox: &Queue, mut sent: mpsc::Receiver<Sent>) {
    while let Err(error) = connected(url, me, inbox, &mut sent).await {
        inbox.note(|health| {
            (health.connected, health.last_error) = (false, Some(plain(&error.to_string())));
        });
        if sent.is_closed() {
            return;
        }
        time::sleep(AGAIN_AFTER).await;
    }
}

/// One connection; `Ok` when nobody wants it any more.
async fn connected(
    url: &Url,
    me: Address,
    inbox: &Queue,
    sent: &mut mpsc::Receiver<Sent>,
) -> Result<(), Box<dyn Error + Send + Sync>> {
    let name = format!("mufasa.{me}.{}", std::process::id());
    let opening = async {
        let addresses = url.socket_addrs(|| Some(PORT))?;
        let stream = TcpStream::connect(addresses.as_slice()).await?;
        // Else the second message of a cycle waits 40 ms until the first is acknowledged.
        stream.set_nodelay(true)?;
        let mut builder = Connection::builder().container_id(name.as_str()).scheme("amqp");
        builder = builder.hostname(url.host_str()).idle_time_out(SILENT_MS);
        if let Some(credentials) = credentials(url) {
            builder = builder.sasl_profile(SaslProfile::from(credentials));
        }
        let mut connection = builder.open_with_stream(stream).await.map_err(in_words)?;
        let mut session = Session::begin(&mut connection).await?;
        let sender = Sender::builder()
            .name("out")
            .target(EXCHANGE)
            .sender_settle_mode(SenderSettleMode::Settled)
            .attach(&mut session);
        let sender = sender.await?;
        let mut receivers = Vec::new();
        for address in [me, me.all()] {
            let mut receiver = Receiver::builder()
                .name(format!("in.{address}"))
                .source(format!("{EXCHANGE}/{address}"))
                .sender_settle_mode(SenderSettleMode::Settled)
                // The library renews the credit of itself only for what is not settled.
                .credit_mode(CreditMode::Manual)
                .attach(&mut session)
                .await?;
            receiver.set_credit(CREDIT).await?;
            receivers.push(receiver);
        }
        Ok::<_, Box<dyn Error + Send + Sync>>((connection, session, sender, receivers))
    };
    let opened = time::timeout(CONNECTED_WITHIN, opening).await??;
    let (mut connection, _session, mut sender, mut receivers) = opened;
    inbox.note(|health| {
        health.connected = true;
        health.connections += 1;
    });
    // What waited for the connection is old.
    while sent.try_recv().is_ok() {
        inbox.note(|health| health.shed += 1);
    }
    let [mine, of_all] = receivers.as_mut_slice() else { return Ok(()) };
    let left = tokio::select! {
        ended = sending(&mut sender, sent) => ended,
        ended = receiving(mine, inbox) => ended,
        ended = receiving(of_all, inbox) => ended,
    };
    if left.is_ok() {
        // A broker that does not answer the farewell is left all the same.
        drop(time::timeout(AGAIN_AFTER, connection.close()).await);
    }
    left
}

/// User and password of a URL, in which `%40` stands for `@`.
fn credentials(url: &Url) -> Option<(String, String)> {
    let decoded = |it: &str| percent_decode_str(it).decode_utf8_lossy().into_owned();
    Some((decoded(url.username()), decoded(url.password()?)))
}

/// Why a connection was not opened; who is refused is told so.
fn in_words(error: OpenError) -> String {
    match error {
        OpenError::SaslError { code: SaslCode::Auth, .. } => {
            "the broker refuses this user or password".to_owned()
        }
        error => error.to_string(),
    }
}

/// What the library says, without its types.
fn plain(error: &str) -> String {
    if let Some((_, behind)) = error.split_once("description: Some(\"") {
        let description = behind.split('"').next().unwrap_or_default();
        return format!("the broker says: {description}");
    }
    if error.contains("ConnectionStopped") {
        return "the broker has closed the connection".to_owned();
    }
    error.to_owned()
}

/// Sends what is handed over, until nobody hands over anything any more.
async fn sending(
    sender: &mut Sender,
    sent: &mut mpsc::Receiver<Sent>,
) -> Result<(), Box<dyn Error + Send + Sync>> {
    while let Some((to, bytes)) = sent.recv().await {
        let header = Header { ttl: Some(KEPT_MS), ..Header::default() };
        let properties = Properties { subject: Some(to.to_string()), ..Properties::default() };
        let message = Message::builder().header(header).properties(properties);
        time::timeout(CONNECTED_WITHIN, sender.send(message.data(bytes).build())).await??;
    }
    Ok(())
}

/// Puts what comes into the inbox, until the connection ends.
async fn receiving(
    receiver: &mut Receiver,
    inbox: &Queue,
) -> Result<(), Box<dyn Error + Send + Sync>> {
    let mut left = CREDIT;
    loop {
        if left <= CREDIT / 2 {
            receiver.set_credit(CREDIT).await?;
            left = CREDIT;
        }
        left -= 1;
        match receiver.recv::<Body<Value>>().await {
            Ok(delivery) => match delivery.into_body() {
                Body::Data(batch) => match batch.into_iter().next() {
                    Some(Data(bytes)) if bytes.len() <= MESSAGE_MAX => inbox.push(bytes.to_vec()),
                    Some(_) | None => inbox.note(|health| health.shed += 1),
                },
                Body::Value(_) | Body::Sequence(_) | Body::Empty => {
                    inbox.note(|health| health.shed += 1);
                }
            },
            // One bad message is no reason to leave.
            Err(RecvError::MessageDecode(_)) => inbox.note(|health| health.shed += 1),
            Err(error) => return Err(error.into()),
        }
    }
}

/// What is before the last `@` is for nobody else to read.
fn without_password(url: &str) -> String {
    url.rsplit_once('@').map_or_else(|| url.to_owned(), |(_, host)| format!("...@{host}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_address_of_a_broker_is_refused() {
        for url in ["", "amqp://", "localhost", "http://localhost", "amqp://a b"] {
            let error = Amqp::new(url, Address::Vehicle(1)).unwrap_err();
            assert!(error.to_string().contains("no address of a broker"), "{url}");
        }
        let with_password = Amqp::new("http://guest:secret@host", Address::Vehicle(1)).unwrap_err();
        let words = with_password.to_string();
        assert!(words.contains("...@host") && !words.contains("secret"), "{words}");
        let elsewhere =
            Amqp::new("amqp://guest:secret@host:5672/vh", Address::Vehicle(1)).unwrap_err();
        assert!(
            elsewhere.to_string().contains("\"...@host:5672/vh\" names a virtual host"),
            "{elsewhere}"
        );
        let tls = Amqp::new("amqps://guest:secret@localhost", Address::Vehicle(1)).unwrap_err();
        assert!(tls.to_string().contains("has no TLS"), "{tls}");
    }

    #[test]
    fn user_and_password_may_have_any_letters() {
        let url = Url::parse("amqp://b%40b:p%40s%3As%2F1@host:5672").unwrap();
        assert_eq!(credentials(&url), Some(("b@b".to_owned(), "p@s:s/1".to_owned())));
        assert_eq!(credentials(&Url::parse("amqp://host").unwrap()), None);
    }

    #[test]
    fn errors_are_told_without_the_types_of_the_library() {
        let closed = "Local error: SessionStopped(ConnectionStopped(Closed))";
        assert_eq!(plain(closed), "the broker has closed the connection");
        let refused = "RemoteEndedWithError(Error { condition: AmqpError(UnauthorizedAccess), description: \
                       Some(\"ACCESS_REFUSED - access to queue refused\"), info: None })";
        assert_eq!(plain(refused), "the broker says: ACCESS_REFUSED - access to queue refused");
        assert_eq!(plain("Connection refused (os error 111)"), "Connection refused (os error 111)");
    }

    #[test]
    fn a_broker_that_is_not_there_is_no_error_and_sends_wait_in_bounded_memory() {
        // Port 1 of the loopback: nobody listens there.
        let mut amqp = Amqp::new("amqp://guest:guest@127.0.0.1:1", Address::Vehicle(1)).unwrap();
        (0..1_000).for_each(|_| amqp.send(0, Address::Station(1), vec![0]));
        assert_eq!(amqp.receive(0), None);
        assert!(amqp.health().shed >= 1_000 - u64::try_from(WAITING_MAX).unwrap());
        assert_eq!(amqp.health().connections, 0);
    }
}
